#include "partwise/imaging/hdr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

TEST(Hdr, KeepsEachValueTo256thOfThePixelsLargest) {
  const TestFolder folder;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(-30, 30);
  for (const int width : {1, 7, 8, 131, 700}) {  // without runs and with
    Image image(width, 5, 3);
    for (float& value : image.values) value = std::exp2(exponent(random));
    for (int x = 0; x < width / 2; ++x) std::copy_n(image.pixel(0, 3), 3, image.pixel(x, 3));  // something to run
    write_hdr(folder.path() / "a.hdr", image);
    const Image back = read_hdr(folder.path() / "a.hdr");
    ASSERT_EQ(back.width, width);
    ASSERT_EQ(back.height, 5);
    for (std::size_t i = 0; i < image.values.size(); ++i) {
      const auto pixel = image.values.begin() + static_cast<std::ptrdiff_t>(i / 3 * 3);
      EXPECT_NEAR(back.values[i], image.values[i], *std::max_element(pixel, pixel + 3) / 256);
    }
    EXPECT_EQ(encode_hdr(back), encode_hdr(image));
  }
}

TEST(Hdr, RowsOfOneColourTakeFewBytes) {
  EXPECT_LT(encode_hdr(Image(1000, 10, 3, 0.5f)).size(), 10 * 4 * 2 * 8 + 200u);
}

TEST(Hdr, WhatTheFormatCannotHoldBecomesTheNearest) {
  Image image(2, 1, 3);
  image.values = {-1, 4, std::numeric_limits<float>::quiet_NaN(), 0, 0, std::numeric_limits<float>::infinity()};
  const Image back = decode_hdr("a", encode_hdr(image));
  EXPECT_NEAR(back.values[0], 0, 4.0f / 256);
  EXPECT_NEAR(back.values[1], 4, 4.0f / 256);
  EXPECT_NEAR(back.values[2], 0, 4.0f / 256);
  EXPECT_GT(back.values[5], 1e38f);
  EXPECT_TRUE(std::isfinite(back.values[5]));
}

TEST(Hdr, DecodesByHand) {
  // Exponent 130: the unit is 2^(130 - 136) = 1 / 64, and a code stands for its middle.
  const std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 1 +X 1\n\x80\x40\x01\x82";
  EXPECT_THAT(decode_hdr("a", bytes).values, testing::ElementsAre(128.5f / 128, 64.5f / 128, 1.5f / 128));
}

}  // namespace
}  // namespace partwise
