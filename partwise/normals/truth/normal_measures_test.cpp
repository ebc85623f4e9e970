#include "partwise/normals/truth/normal_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/normals/truth/test_depths.h"

namespace partwise {
namespace {

using testing::DoubleNear;

constexpr double radians = std::numbers::pi / 180;

// Normals to the camera, and beside them some that are turned away from these by given angles, each another way round.
struct Turned {
  explicit Turned(const std::vector<double>& degrees) : truth(static_cast<int>(degrees.size()), 1, 3), normals(truth) {
    for (std::size_t i = 0; i < degrees.size(); ++i) {
      const int x = static_cast<int>(i);
      truth.pixel(x, 0)[2] = 1;
      const Eigen::Vector3d turned = test::slanted(degrees[i], 77.0 * x);
      Eigen::Map<Eigen::Vector3f>(normals.pixel(x, 0)) = turned.cast<float>();
    }
  }
  Image truth, normals;
};

TEST(NormalMeasure, FiguresAreThoseOfTheAngles) {
  const std::vector<double> degrees{3, 6, 10, 20, 25, 40, 90, 150};
  const Turned image(degrees);
  NormalMeasure measure;
  measure.add(image.normals, image.truth);
  const NormalErrors errors = measure.errors();
  double mean = 0, squares = 0, cosine = 0;
  for (const double each : degrees) {
    mean += each / 8, squares += each * each / 8, cosine += std::cos(each * radians) / 8;
  }
  EXPECT_EQ(errors.pixels, 8u);
  EXPECT_NEAR(errors.mean, mean, 1e-5);
  EXPECT_NEAR(errors.rmse, std::sqrt(squares), 1e-5);
  EXPECT_NEAR(errors.median, 22.5, 1e-3);
  EXPECT_NEAR(errors.cosine, cosine, 1e-7);
  EXPECT_THAT(errors.share_below, testing::ElementsAre(1.0 / 8, 2.0 / 8, 3.0 / 8, 4.0 / 8, 5.0 / 8));
}

TEST(NormalMeasure, LengthsDoNotMatterAndEqualNormalsDifferByNothing) {
  Turned image({0, 0, 30});
  for (int k = 0; k < 3; ++k) image.normals.pixel(1, 0)[k] *= 0.3f, image.truth.pixel(2, 0)[k] *= 7;
  NormalMeasure measure;
  measure.add(image.normals, image.truth);
  EXPECT_NEAR(measure.errors().mean, 10, 1e-5);
  EXPECT_EQ(measure.errors().median, 0);
}

TEST(NormalMeasure, PixelsCountWhereThereIsATrueNormalUnderTheMask) {
  Turned image({8, 16, 24, 32, 40});
  std::fill_n(image.truth.pixel(3, 0), 3, 0.0f);
  image.truth.pixel(4, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  Mask mask(5, 1, 1, 1);
  mask.pixel(0, 0)[0] = 0.5f;
  NormalMeasure whole, masked;
  whole.add(image.normals, image.truth);
  masked.add(image.normals, image.truth, mask);
  EXPECT_EQ(whole.errors().pixels, 3u);
  EXPECT_NEAR(whole.errors().median, 16, 1e-3);
  EXPECT_EQ(masked.errors().pixels, 2u);
  EXPECT_NEAR(masked.errors().mean, 20, 1e-5);
}

TEST(NormalMeasure, AMissingNormalIsOffByARightAngle) {
  Turned image({0, 0});
  std::fill_n(image.normals.pixel(0, 0), 3, 0.0f);
  image.normals.pixel(1, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  NormalMeasure measure;
  measure.add(image.normals, image.truth);
  EXPECT_NEAR(measure.errors().mean, 90, 1e-12);
  EXPECT_EQ(measure.errors().cosine, 0);
}

TEST(NormalMeasure, NoPixelsGiveNoFigures) {
  NormalMeasure measure;
  measure.add(Image(3, 3, 3, 1), Image(3, 3, 3));
  EXPECT_EQ(measure.errors().pixels, 0u);
  EXPECT_EQ(measure.errors().mean, 0);
}

// Directions all over the sphere: the angle's density is sin(a) / 2, the mean 90, the mean square pi^2 / 2 - 2.
TEST(NormalMeasure, EvenDirectionsGiveTheSpheresFigures) {
  std::mt19937 random(5);
  std::normal_distribution<float> value;
  Image normals(400, 500, 3);
  for (float& each : normals.values) each = value(random);
  Image truth(400, 500, 3);
  for (int y = 0; y < 500; ++y) {
    for (int x = 0; x < 400; ++x) truth.pixel(x, y)[x % 3] = y % 2 == 0 ? 1 : -1;
  }
  NormalMeasure measure;
  measure.add(normals, truth);
  const NormalErrors errors = measure.errors();
  EXPECT_NEAR(errors.mean, 90, 0.4);
  EXPECT_NEAR(errors.median, 90, 0.6);
  EXPECT_NEAR(errors.rmse, std::sqrt(std::numbers::pi * std::numbers::pi / 2 - 2) / radians, 0.4);
  EXPECT_NEAR(errors.cosine, 0, 6e-3);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(errors.share_below[k], (1 - std::cos(normal_error_limits[k] * radians)) / 2, 2e-3);
  }
}

TEST(NormalMeasure, PoolsPixelsNotImages) {
  const Turned few({10}), many({20, 20, 20});
  NormalMeasure one, other, both;
  one.add(few.normals, few.truth);
  other.add(many.normals, many.truth);
  both.add(few.normals, few.truth);
  both.add(many.normals, many.truth);
  one.add(other);
  for (const NormalMeasure& pooled : {one, both}) {
    EXPECT_EQ(pooled.errors().pixels, 4u);
    EXPECT_NEAR(pooled.errors().mean, 17.5, 1e-5);
    EXPECT_NEAR(pooled.errors().median, 20, 1e-3);
    EXPECT_EQ(pooled.errors().share_below[2], 0.25);
  }
}

TEST(NormalMeasure, TheMedianIsThatOfTheSortedAngles) {
  std::mt19937 random(9);
  std::vector<double> degrees(1001);
  for (double& each : degrees) each = std::uniform_real_distribution<double>(0, 60)(random);
  const Turned image(degrees);
  NormalMeasure measure;
  measure.add(image.normals, image.truth);
  std::ranges::sort(degrees);
  EXPECT_THAT(measure.errors().median, DoubleNear(degrees[500], 1e-3));
}

TEST(NormalMeasure, RefusesSizesThatDoNotFit) {
  NormalMeasure measure;
  EXPECT_THROW(measure.add(Image(3, 2, 3), Image(2, 3, 3)), CheckFailed);
  EXPECT_THROW(measure.add(Image(3, 2, 1), Image(3, 2, 1)), CheckFailed);
  EXPECT_THROW(measure.add(Image(3, 2, 3), Image(3, 2, 3), Mask(3, 3, 1)), CheckFailed);
}

}  // namespace
}  // namespace partwise
