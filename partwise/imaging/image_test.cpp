#include "partwise/imaging/image.h"

#include <gtest/gtest.h>

#include "partwise/base/error.h"

namespace partwise {
namespace {

TEST(Image, IsRowMajorAndInterleaved) {
  Image image(3, 2, 4, 0.5f);
  ASSERT_EQ(image.values.size(), 24u);
  image.pixel(1, 1)[2] = 7;
  EXPECT_EQ(image.values[(1 * 3 + 1) * 4 + 2], 7);
  EXPECT_THROW(Image(0, 2, 3), CheckFailed);
  EXPECT_THROW(Image(2, 2, 5), CheckFailed);
}

TEST(Srgb, MeetsTheStandardAndInverts) {
  EXPECT_FLOAT_EQ(srgb_from_linear(0), 0);
  EXPECT_FLOAT_EQ(srgb_from_linear(1), 1);
  EXPECT_NEAR(srgb_from_linear(0.2140411f), 0.5f, 1e-6f);  // middle code of the standard's curve
  for (int code = 0; code <= 255; ++code) {
    const float value = static_cast<float>(code) / 255;
    EXPECT_NEAR(srgb_from_linear(linear_from_srgb(value)), value, 1e-6f);
  }
}

}  // namespace
}  // namespace partwise
