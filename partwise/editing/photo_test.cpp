#include "partwise/editing/photo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

class PhotoFiles : public testing::Test {
 protected:
  std::filesystem::path write(const char* name, const Image& image, PngCodes codes = PngCodes::plain8) const {
    const std::filesystem::path path = folder_.path() / name;
    write_png(path, image, codes);
    return path;
  }
  // 20 x 10, with a block of another colour in columns 6 to 11, rows 2 to 7.
  static Image block(int channels, float ground, float object, float alpha_ground = 1) {
    Image image(20, 10, channels);
    for (int y = 0; y < 10; ++y) {
      for (int x = 0; x < 20; ++x) {
        const bool inside = x >= 6 && x < 12 && y >= 2 && y < 8;
        for (int c = 0; c < channels; ++c) image.pixel(x, y)[c] = inside ? object : ground;
        if (channels == 2 || channels == 4) image.pixel(x, y)[channels - 1] = inside ? 1 : alpha_ground;
      }
    }
    return image;
  }
  static double area(const Image& mask) {
    return static_cast<double>(std::ranges::count_if(mask.values, [](float value) { return value > 0.5f; }));
  }

  TestFolder folder_;
};

TEST_F(PhotoFiles, PlainBackgroundsAndTransparency) {
  for (const int channels : {1, 3}) {
    for (const PngCodes codes : {PngCodes::plain8, PngCodes::plain16}) {
      const Photo photo = read_photo(write("a.png", block(channels, 0.9f, 0.2f), codes), {});
      EXPECT_EQ(area(photo.regions.at(0)), 36);
      EXPECT_EQ(photo.shown.channels, 3);
      EXPECT_NEAR(photo.shown.pixel(7, 3)[2], 0.2f, 2e-3);
      EXPECT_FALSE(photo.has_alpha);
    }
  }
  for (const int channels : {2, 4}) {
    const Photo photo = read_photo(write("b.png", block(channels, 0.5f, 0.5f, 0)), {});  // told by alpha alone
    EXPECT_EQ(area(photo.regions.at(0)), 36);
    EXPECT_TRUE(photo.has_alpha);
  }
}

TEST_F(PhotoFiles, AHoleOfTheGroundsColourBelongsToTheObject) {
  Image image = block(3, 0.9f, 0.2f);
  for (int c = 0; c < 3; ++c) image.pixel(8, 4)[c] = 0.9f;
  EXPECT_EQ(area(read_photo(write("a.png", image), {}).regions.at(0)), 36);
}

TEST_F(PhotoFiles, LaterMasksLieOverEarlierOnes) {
  const auto photo = write("a.png", Image(20, 10, 3, 0.4f)), all = write("all.png", block(1, 0, 1));
  Image left = block(1, 0, 1);
  for (int y = 0; y < 10; ++y)
    for (int x = 9; x < 20; ++x) *left.pixel(x, y) = 0;
  const Photo read = read_photo(photo, {all, write("left.png", left)});
  ASSERT_EQ(read.regions.size(), 2u);
  EXPECT_EQ(area(read.regions[0]), 18);
  EXPECT_EQ(area(read.regions[1]), 18);
  EXPECT_THROW(read_photo(photo, {write("left.png", left), all}), InputError);  // nothing of the first is left
}

TEST_F(PhotoFiles, WhatCannotBeEdited) {
  const auto busy = [] {
    Image image(20, 10, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = static_cast<float>(i * 37 % 101) / 101;
    return image;
  }();
  EXPECT_THROW(read_photo(write("busy.png", busy), {}), InputError);
  EXPECT_THROW(read_photo(write("flat.png", Image(20, 10, 3, 0.5f)), {}), InputError);
  EXPECT_THROW(read_photo(write("clear.png", Image(20, 10, 4, 0)), {}), InputError);
  EXPECT_THROW(read_photo(write("busy.png", busy), {write("dark.png", Image(20, 10, 1, 0))}), InputError);
  EXPECT_THROW(read_photo(write("busy.png", busy), {write("small.png", Image(10, 10, 1, 1))}), InputError);
  EXPECT_THROW(read_photo(folder_.path() / "none.png", {}), InputError);
}

TEST_F(PhotoFiles, TheCropHoldsTheObjectWithAMargin) {
  const Photo photo = read_photo(write("a.png", block(3, 0.9f, 0.2f)), {});
  const Crop crop = crop_of(photo);
  EXPECT_EQ(crop.side, 9);  // 36 pixels are at most half of it
  EXPECT_EQ(crop.x, 4);
  EXPECT_EQ(crop.y, 0);
  Photo line;
  line.shown = Image(100, 50, 3);
  line.regions = {Image(100, 50, 1)};
  for (int x = 20; x < 60; ++x) *line.regions[0].pixel(x, 0) = 1;
  const Crop wide = crop_of(line);
  EXPECT_EQ(wide.side, 44);
  EXPECT_LT(wide.y, 0);  // reaches beyond the photo
}

}  // namespace
}  // namespace partwise
