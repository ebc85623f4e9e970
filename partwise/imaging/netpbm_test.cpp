#include "partwise/imaging/netpbm.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/imaging/image_io.h"

namespace partwise {
namespace {

using namespace std::string_literals;
using testing::ElementsAre;

TEST(Netpbm, CodesStandRowByRowHighByteFirst) {
  const Image wide = decode_plain_netpbm("a", "P5 2 1 65535\n\x01\x02\xff\xff"s);
  EXPECT_EQ(wide.channels, 1);
  EXPECT_THAT(wide.values, ElementsAre(258.0f / 65535, 1));
  const Image colour = decode_plain_netpbm("a", "P6\n# a camera's\n1 2 # two rows\n255\n\x00\x33\xff\x66\x99\xcc"s);
  EXPECT_EQ(colour.channels, 3);
  EXPECT_EQ(colour.height, 2);
  EXPECT_THAT(colour.values, ElementsAre(0, 0.2f, 1, 0.4f, 0.6f, 0.8f));
}

TEST(Netpbm, TheLargestCodeIsOneAndTheFirstBlankEndsTheHeader) {
  // The first sample is a line feed as well.
  EXPECT_THAT(decode_plain_netpbm("a", "P5 3 1 20\n\n\x14\x05"s).values, ElementsAre(0.5f, 1, 0.25f));
  EXPECT_THAT(decode_plain_netpbm("a", "P5 1 1 256\n\x01\x00"s).values, ElementsAre(1));
}

TEST(Netpbm, BytesAfterThePictureAreNotRead) {
  EXPECT_THAT(decode_plain_netpbm("a", "P5 1 1 255\n\xffP5 9 9"s).values, ElementsAre(1));
}

TEST(Netpbm, ReadImageMakesItLinear) {
  const TestFolder folder;
  write_file(folder.path() / "a.PPM", "P6 1 1 255\n\xff\xbc\x00"s);
  const Image image = read_image(folder.path() / "a.PPM");
  EXPECT_EQ(image.values[0], 1);
  EXPECT_NEAR(image.values[1], 0.5029f, 1e-4f);  // sRGB's 188 is half of the light
  EXPECT_EQ(image.values[2], 0);
}

TEST(Netpbm, WhateverIsLeftOfAFileGivesAMessage) {
  const std::string whole = "P6 # a\n3 2\n65535\n"s + std::string(36, 'x');
  EXPECT_NO_THROW(decode_plain_netpbm("a", whole));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_THROW(decode_plain_netpbm("a", std::string_view(whole).substr(0, i)), InputError) << i;
  }
}

}  // namespace
}  // namespace partwise
