#include "partwise/appearance/palette.h"

#include <gtest/gtest.h>

#include "partwise/base/error.h"

namespace partwise {
namespace {

TEST(Palette, OklabMeetsItsDefinition) {
  EXPECT_TRUE(linear_from_oklab({1, 0, 0}).isApprox(Eigen::Vector3f::Ones(), 1e-4f));
  EXPECT_TRUE(linear_from_oklab({0.5f, 0, 0}).isApprox(Eigen::Vector3f::Constant(0.125f), 1e-3f));
  // Ottosson's table: sRGB red is (0.6279554, 0.2248631, 0.1258463).
  EXPECT_TRUE(linear_from_oklab({0.6279554f, 0.2248631f, 0.1258463f}).isApprox(Eigen::Vector3f::UnitX(), 1e-4f));
}

TEST(Palette, ColoursAreDisplayableAndApart) {
  float nearest_of_twelve = 1;
  for (int i = 0; i < part_colours; ++i) {
    const Eigen::Vector3f colour = part_colour(i);
    EXPECT_GE(colour.minCoeff(), 0);
    EXPECT_LE(colour.maxCoeff(), 1);
    for (int j = 0; j < i; ++j) {
      EXPECT_NE(colour, part_colour(j)) << i << " " << j;
      if (i < 12) nearest_of_twelve = std::min(nearest_of_twelve, (colour - part_colour(j)).norm());
    }
  }
  EXPECT_GT(nearest_of_twelve, 0.08f);
  EXPECT_EQ(part_colour(part_colours + 3), part_colour(3));
  EXPECT_THROW(part_colour(-1), CheckFailed);
}

TEST(Palette, ValuesRiseInLightness) {
  const auto luminance = [](const Eigen::Vector3f& rgb) { return rgb.dot(Eigen::Vector3f(0.2126f, 0.7152f, 0.0722f)); };
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3f colour = value_colour(i / 50.0f), next = value_colour((i + 1) / 50.0f);
    EXPECT_GE(colour.minCoeff(), 0);
    EXPECT_LE(colour.maxCoeff(), 1);
    EXPECT_LT(luminance(colour), luminance(next)) << i;
  }
  EXPECT_EQ(value_colour(-1), value_colour(0));
  EXPECT_EQ(value_colour(2), value_colour(1));
}

}  // namespace
}  // namespace partwise
