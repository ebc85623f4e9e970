#include "partwise/imaging/tone_mapping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace partwise {
namespace {

TEST(ToneMapping, TheForegroundsMedianBecomesMiddleGrey) {
  Image image(5, 1, 1);
  image.values = {100, 1, 2, 3, 100};
  Mask mask(5, 1, 1);
  mask.values = {0, 1, 1, 1, 0};
  EXPECT_FLOAT_EQ(exposure_by_median(image, mask), 0.09f);
  const Image mapped = tone_map(image, 0.09f);
  EXPECT_NEAR(mapped.values[2], 255 * std::pow(0.18, 1 / 2.2), 1e-3);
  EXPECT_EQ(mapped.values[0], 255);
}

TEST(ToneMapping, BlackMediansFallBackOnTheMeanAndBlackImagesOnOne) {
  Image image(4, 1, 1);
  image.values = {0, 0, 0, 8};
  EXPECT_FLOAT_EQ(exposure_by_median(image, Mask(4, 1, 1, 1)), 0.09f);
  EXPECT_EQ(exposure_by_median(Image(4, 1, 3), Mask(4, 1, 1, 1)), 1);
  EXPECT_EQ(exposure_by_median(image, Mask(4, 1, 1, 0)), 1);
}

TEST(ToneMapping, AlphaHasNoCurve) {
  Image image(1, 1, 4);
  image.values = {-1, 0.5f, 2, 0.5f};
  const Image mapped = tone_map(image, 1);
  EXPECT_THAT(mapped.values,
              testing::ElementsAre(0, testing::FloatNear(255 * std::pow(0.5f, 1 / 2.2f), 1e-3f), 255, 127.5f));
}

}  // namespace
}  // namespace partwise
