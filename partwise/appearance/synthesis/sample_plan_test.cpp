#include "partwise/appearance/synthesis/sample_plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "partwise/base/error.h"

namespace partwise {
namespace {

int parts_of(int shape) { return std::array{1, 3, 9, 20}[static_cast<std::size_t>(shape)]; }

const SamplePlan plan{.seed = 7, .shapes = 4, .materials = 9, .lights = 3, .parts = parts_of};

TEST(SamplePlan, ImagesOfACombinationDifferInTheirViewAlone) {
  for (std::uint64_t combination = 0; combination < 50; ++combination) {
    const Sample first = sample(plan, 5 * combination);
    std::set<int> viewpoints;
    for (std::uint64_t view = 0; view < 5; ++view) {
      const Sample each = sample(plan, 5 * combination + view);
      EXPECT_EQ(each.shape, first.shape);
      EXPECT_EQ(each.light, first.light);
      EXPECT_EQ(each.light_turn, first.light_turn);
      EXPECT_EQ(each.materials, first.materials);
      viewpoints.insert(each.viewpoint);
    }
    EXPECT_EQ(viewpoints.size(), 5u);
    EXPECT_GE(*viewpoints.begin(), 0);
    EXPECT_LT(*viewpoints.rbegin(), 24);
  }
}

TEST(SamplePlan, PartsWearDifferentMaterialsAsFarAsThereAreEnough) {
  for (std::uint64_t number = 0; number < 500; number += 5) {
    const Sample each = sample(plan, number);
    ASSERT_EQ(static_cast<int>(each.materials.size()), parts_of(each.shape));
    std::set<int> used(each.materials.begin(), each.materials.end());
    EXPECT_EQ(used.size(), std::min<std::size_t>(each.materials.size(), 9));
    if (each.shape == 3) {  // 20 parts, 9 materials: each twice or thrice
      for (int m = 0; m < 9; ++m)
        EXPECT_THAT(std::ranges::count(each.materials, m), testing::AllOf(testing::Ge(2), testing::Le(3)));
    }
  }
}

// Pearson's statistic of counts that should be equal, against its mean and deviation for so many degrees of freedom.
void expect_even(const std::vector<int>& counts) {
  double total = 0, chi = 0;
  for (const int count : counts) total += count;
  const double mean = total / static_cast<double>(counts.size());
  for (const int count : counts) chi += (count - mean) * (count - mean) / mean;
  const double freedom = static_cast<double>(counts.size()) - 1;
  EXPECT_NEAR(chi, freedom, 5 * std::sqrt(2 * freedom));
}

TEST(SamplePlan, EverythingIsDrawnEvenly) {
  std::vector<int> shapes(4), lights(3), viewpoints(24), turns(16), first_material(9);
  std::vector<int> shape_and_light(12);
  for (std::uint64_t combination = 0; combination < 20000; ++combination) {
    const Sample each = sample(plan, 5 * combination);
    ++shapes[each.shape], ++lights[each.light], ++viewpoints[each.viewpoint], ++first_material[each.materials[0]];
    ++turns[static_cast<std::size_t>(each.light_turn / (2 * std::numbers::pi) * 16)];
    ++shape_and_light[3 * each.shape + each.light];
  }
  for (const auto& counts : {shapes, lights, viewpoints, turns, first_material, shape_and_light}) expect_even(counts);
}

TEST(SamplePlan, SeedsGiveOtherImages) {
  SamplePlan other = plan;
  other.seed = 8;
  int same = 0;
  for (std::uint64_t number = 0; number < 500; number += 5)
    same += sample(plan, number).light_turn == sample(other, number).light_turn;
  EXPECT_EQ(same, 0);
}

TEST(SamplePlan, RefusesWhatCannotBeDrawn) {
  SamplePlan wrong = plan;
  wrong.views = 25;
  EXPECT_THROW(sample(wrong, 0), InputError);
  wrong = plan;
  wrong.materials = 0;
  EXPECT_THROW(sample(wrong, 0), InputError);
}

}  // namespace
}  // namespace partwise
