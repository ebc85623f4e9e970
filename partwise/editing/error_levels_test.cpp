#include "partwise/editing/error_levels.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/utils.h>

#include <array>

namespace partwise {
namespace {

at::Tensor everywhere(std::int64_t rows, std::int64_t columns) { return at::ones({1, 1, rows, columns}); }

TEST(ErrorLevels, AFieldIsTheSumOfItsLevels) {
  ErrorLevels levels(8, 16, std::array{0.5, 2.0, 1.0, 0.25, 3.0}, true);
  ASSERT_EQ(levels.levels().size(), 4u);  // none of 16 rows
  EXPECT_EQ(levels.levels()[1].sizes(), (std::vector<std::int64_t>{1, 3, 2, 4}));
  EXPECT_EQ(levels.field().abs().max().item<float>(), 0);
  levels.levels()[0].fill_(2);
  levels.levels()[3].fill_(-4);  // as fine as the field
  EXPECT_LT((levels.field() - (0.5 * 2 - 0.25 * 4)).abs().max().item<double>(), 1e-6);
  EXPECT_EQ(levels.square().item<float>(), 4 * 6 + 16 * 3 * 8 * 16);
}

// What lies half a pixel of a coarse level beyond the last column is half the first one.
TEST(ErrorLevels, WrapAround) {
  for (const bool wraps : {false, true}) {
    ErrorLevels levels(4, 8, std::array{0.0, 1.0}, wraps);
    levels.levels()[1].narrow(3, 0, 1).fill_(1);
    const at::Tensor row = levels.field()[0][0][0];
    EXPECT_NEAR(row[7].item<float>(), wraps ? 0.25f : 0.0f, 1e-6);
    EXPECT_NEAR(row[0].item<float>(), wraps ? 0.75f : 1.0f, 1e-6);
    EXPECT_NEAR(row[1].item<float>(), 0.75f, 1e-6);
  }
}

// Enlarging blurs, so that a level's deviation is less than it was drawn with, and some of it falls to its neighbours.
TEST(ErrorLevels, DeviationsOfDrawnFieldsAreFoundAgain) {
  torch::manual_seed(5);
  for (const std::size_t loud : {2u, 4u}) {
    std::array<double, 6> deviations{};
    deviations[loud] = 1;
    std::vector<double> found(6);
    constexpr int fields = 20;
    for (int i = 0; i < fields; ++i) {
      ErrorLevels levels(32, 64, deviations, true);
      for (at::Tensor& each : levels.levels()) each = torch::randn_like(each);
      const std::vector<double> one = level_deviations(levels.field(), everywhere(32, 64));
      ASSERT_EQ(one.size(), found.size());
      for (std::size_t k = 0; k < one.size(); ++k) found[k] += one[k] / fields;
    }
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (k != loud) {
        EXPECT_LT(found[k], found[loud]) << k << " beside " << loud;
      }
    }
    EXPECT_GT(found[loud], 0.4);
    EXPECT_LT(found[loud], 1);
  }
}

TEST(ErrorLevels, DeviationsAreThoseUnderTheMask) {
  at::Tensor field = at::full({1, 3, 8, 8}, 100), mask = at::zeros({1, 1, 8, 8});
  field.narrow(2, 0, 4).fill_(2);
  mask.narrow(2, 0, 4).fill_(1);
  const std::vector<double> found = level_deviations(field, mask);
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found[0], 2, 1e-5);  // the whole: the rest adds nothing
  for (std::size_t k = 1; k < found.size(); ++k) EXPECT_NEAR(found[k], 0, 1e-5);
}

}  // namespace
}  // namespace partwise
