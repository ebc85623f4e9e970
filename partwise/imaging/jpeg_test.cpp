#include "partwise/imaging/jpeg.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <jpeglib.h>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Red grows to the right, green downwards.
std::string written(int width, int height, int channels, int orientation = 0, bool big_endian = false) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : (channels == 3 ? JCS_RGB : JCS_CMYK);
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 95, TRUE);
  jpeg_start_compress(&jpeg, TRUE);
  if (orientation > 0) {
    const auto two = [&](int value) {
      std::string result{static_cast<char>(value >> 8), static_cast<char>(value & 0xFF)};
      return big_endian ? result : std::string(result.rbegin(), result.rend());
    };
    const auto four = [&](int value) { return big_endian ? two(0) + two(value) : two(value) + two(0); };
    const std::string exif = std::string("Exif\0\0", 6) + (big_endian ? "MM" : "II") + two(42) + four(8) + two(1) +
                             two(0x0112) + two(3) + four(1) + two(orientation) + two(0) + four(0);
    jpeg_write_marker(&jpeg, JPEG_APP0 + 1, reinterpret_cast<const JOCTET*>(exif.data()),
                      static_cast<unsigned>(exif.size()));
  }
  std::vector<unsigned char> row(static_cast<std::size_t>(width * channels));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c)
        row[static_cast<std::size_t>(x * channels + c)] =
            static_cast<unsigned char>(c == 0 ? 255 * x / (width - 1) : (c == 1 ? 255 * y / (height - 1) : 40));
    }
    JSAMPROW line = row.data();
    jpeg_write_scanlines(&jpeg, &line, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  std::string result(reinterpret_cast<char*>(bytes), size);
  std::free(bytes);
  return result;
}

TEST(Jpeg, ColoursAndGrey) {
  const Image colour = decode_plain_jpeg("a.jpg", written(48, 32, 3));
  ASSERT_EQ(colour.channels, 3);
  for (const int x : {0, 20, 47}) {
    for (const int y : {0, 15, 31}) {
      EXPECT_NEAR(colour.pixel(x, y)[0], x / 47.0, 0.04);
      EXPECT_NEAR(colour.pixel(x, y)[1], y / 31.0, 0.04);
    }
  }
  const Image grey = decode_plain_jpeg("a.jpg", written(48, 32, 1));
  ASSERT_EQ(grey.channels, 1);
  EXPECT_NEAR(*grey.pixel(20, 7), 20 / 47.0, 0.02);
}

// Where each orientation of the stored picture puts its top left and top right corners: EXIF 2.3, table of tag 0x0112.
TEST(Jpeg, IsTurnedUpright) {
  struct Corners {
    bool left_below, left_right, right_below, right_right;
  };
  const std::vector<Corners> expected = {
      {false, false, false, true}, {false, true, false, false}, {true, true, true, false}, {true, false, true, true},
      {false, false, true, false}, {false, true, true, true},   {true, true, false, true}, {true, false, false, false}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    for (const bool big : {false, true}) {
      const Image image = decode_plain_jpeg("a.jpg", written(48, 32, 3, orientation, big));
      ASSERT_EQ(image.width, orientation < 5 ? 48 : 32);
      const auto corner = [&](bool below, bool right) {
        return image.pixel(right ? image.width - 1 : 0, below ? image.height - 1 : 0);
      };
      const Corners& each = expected[static_cast<std::size_t>(orientation - 1)];
      const float* left = corner(each.left_below, each.left_right);     // stored at (0, 0): no red, no green
      const float* right = corner(each.right_below, each.right_right);  // stored at the right end of the top row: red
      EXPECT_LT(left[0] + left[1], 0.1) << orientation;
      EXPECT_GT(right[0], 0.9) << orientation;
      EXPECT_LT(right[1], 0.1) << orientation;
    }
  }
}

TEST(Jpeg, WhatIsNot) {
  const std::string whole = written(48, 32, 3);
  EXPECT_THROW(decode_plain_jpeg("a.jpg", ""), InputError);
  EXPECT_THROW(decode_plain_jpeg("a.jpg", "\x89PNG"), InputError);
  EXPECT_THROW(decode_plain_jpeg("a.jpg", written(48, 32, 4)), InputError);
  for (std::size_t size = 3; size + 2 < whole.size(); size += 17)
    EXPECT_THROW(decode_plain_jpeg("a.jpg", std::string_view(whole).substr(0, size)), InputError) << size;
  std::string huge = whole;  // the frame header says how large it is
  const std::size_t frame = huge.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  for (const std::size_t i : {5, 6, 7, 8}) huge[frame + i] = '\xFF';
  EXPECT_THROW(decode_plain_jpeg("a.jpg", huge), InputError);
  for (std::size_t i = 2; i < whole.size(); i += 5) {  // damaged anywhere: an error or a picture, never more
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    try {
      decode_plain_jpeg("a.jpg", damaged);
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace partwise
