#include "partwise/imaging/exr.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "partwise/base/error.h"
#include "partwise/base/shared_files.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

Image waves(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    image.values[i] = 100 * std::sin(0.37f * static_cast<float>(i));
  }
  return image;
}

TEST(Exr, SinglePrecisionComesBackToTheBit) {
  const TestFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    Image image = waves(23, 17, channels);
    image.values[0] = std::numeric_limits<float>::infinity();
    write_exr(folder.path() / "a.exr", image, ExrPrecision::single);
    const Image back = read_exr(folder.path() / "a.exr");
    ASSERT_EQ(back.width, 23);
    ASSERT_EQ(back.height, 17);
    ASSERT_EQ(back.channels, channels);
    EXPECT_EQ(back.values, image.values);
    EXPECT_EQ(encode_exr(back, ExrPrecision::single), encode_exr(image, ExrPrecision::single));
  }
}

TEST(Exr, HalfPrecisionKeepsElevenBitsAndStaysFinite) {
  Image image = waves(9, 4, 3);
  image.values[5] = 1e9f, image.values[7] = -1e9f;
  const Image back = decode_exr("a", encode_exr(image));
  EXPECT_EQ(back.values[5], 65504);
  EXPECT_EQ(back.values[7], -65504);
  for (std::size_t i = 8; i < image.values.size(); ++i) {
    EXPECT_NEAR(back.values[i], image.values[i], std::abs(image.values[i]) / 2048);
  }
}

TEST(Exr, HoldsSeveralLayersAndGivesThemByName) {
  const TestFolder folder;
  const std::vector<ExrLayer> layers = {{waves(6, 5, 3), {"R", "G", "B"}, ExrPrecision::half},
                                        {waves(6, 5, 3), {"normal.X", "normal.Y", "normal.Z"}},
                                        {waves(6, 5, 1), {"Z"}}};
  write_exr(folder.path() / "a.exr", layers);
  EXPECT_EQ(read_exr(folder.path() / "a.exr").channels, 3);  // the colour
  for (std::size_t i = 1; i < layers.size(); ++i) {
    EXPECT_EQ(read_exr(folder.path() / "a.exr", layers[i].channels).values, layers[i].image.values);
  }
  const std::array<std::string, 2> swapped{"normal.Y", "normal.X"};
  const Image back = read_exr(folder.path() / "a.exr", swapped);
  EXPECT_EQ(back.pixel(3, 2)[0], layers[1].image.pixel(3, 2)[1]);
  EXPECT_EQ(back.pixel(3, 2)[1], layers[1].image.pixel(3, 2)[0]);
  const std::array<std::string, 1> missing{"albedo"};
  EXPECT_THROW(read_exr(folder.path() / "a.exr", missing), InputError);
  EXPECT_THROW(encode_exr(std::vector<ExrLayer>{layers[0], layers[0]}), CheckFailed);
}

TEST(Exr, ReadsTheLightsThatShip) {
  const Image sky = read_exr(shared_file("data/lights/sky.exr"));  // DWAB
  EXPECT_EQ(sky.width, 512);
  EXPECT_EQ(sky.height, 256);
  EXPECT_EQ(sky.channels, 3);
}

TEST(Exr, SaysWhatCannotBeWritten) {
  const TestFolder folder;
  EXPECT_THROW(write_exr(folder.path() / "no" / "folder.exr", Image(1, 1, 1)), InputError);
}

}  // namespace
}  // namespace partwise
