#include "partwise/normals/truth/rgbd_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

using testing::HasSubstr;

class RgbdFrameFiles : public testing::Test {
 protected:
  // A depth picture of the usual size whose first codes are these, and a colour beside it.
  RgbdFiles files(RgbdFormat format, const std::vector<int>& codes, int width = 640, int height = 480) {
    RgbdFiles result{format, folder_.path() / "colour.png", folder_.path() / "depth.png"};
    write_png(result.colour, Image(width, height, 3, 1));
    if (format == RgbdFormat::nyu) {
      result.depth.replace_extension(".pgm");
      std::string bytes = "P5 " + std::to_string(width) + " " + std::to_string(height) + " 65535\n";
      for (int i = 0; i < width * height; ++i) {
        const int code = i < static_cast<int>(codes.size()) ? codes[static_cast<std::size_t>(i)] : 2047;
        bytes += static_cast<char>(code & 255);
        bytes += static_cast<char>(code >> 8);
      }
      write_file(result.depth, bytes);
    } else {
      Image image(width, height, 1);
      for (std::size_t i = 0; i < codes.size(); ++i) image.values[i] = static_cast<float>(codes[i]) / 65535;
      write_png(result.depth, image, PngCodes::plain16);
    }
    return result;
  }

  std::string message(const RgbdFiles& files) {
    try {
      read_rgbd_frame(files);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      return error.what();
    }
    return "was read";
  }

  TestFolder folder_;
};

TEST_F(RgbdFrameFiles, DepthsAreInMetres) {
  const auto depths = [&](RgbdFormat format, const std::vector<int>& codes) {
    std::vector<float> values = read_rgbd_frame(files(format, codes)).depth.values;
    values.resize(codes.size());
    return values;
  };
  EXPECT_THAT(depths(RgbdFormat::redwood, {0, 1, 1234, 65535}),
              testing::Pointwise(testing::FloatEq(), {0.0f, 0.001f, 1.234f, 65.535f}));
  EXPECT_THAT(depths(RgbdFormat::tum, {0, 5000, 6250}), testing::Pointwise(testing::FloatEq(), {0.0f, 1.0f, 1.25f}));
  // 2345 mm is 0x0929; turned left by 3 bits 0x4948. 8193 mm is 0x2001; its highest bits come round: 0x0009.
  EXPECT_THAT(depths(RgbdFormat::sun, {0, 0x4948, 0x0009}),
              testing::Pointwise(testing::FloatEq(), {0.0f, 2.345f, 8.193f}));
  // 1057 is 10 m but for 0.1 mm; 1093 would be behind the camera.
  EXPECT_THAT(depths(RgbdFormat::nyu, {741, 917, 1057, 1058, 1092, 1093, 2047}),
              testing::Pointwise(testing::FloatNear(1e-5f), {0.999431f, 2.001709f, 9.895775f, 0.0f, 0.0f, 0.0f, 0.0f}));
}

TEST_F(RgbdFrameFiles, ColourIsLinearAndCamerasAreTheDataSets) {
  const RgbdFrame frame = read_rgbd_frame(files(RgbdFormat::redwood, {1}));
  EXPECT_EQ(frame.colour.channels, 3);
  EXPECT_EQ(frame.colour.pixel(5, 5)[1], 1);
  EXPECT_EQ(frame.camera.focal_x, 525);
  EXPECT_EQ(frame.camera.centre_y, 239.5);
  RgbdFiles tum = files(RgbdFormat::tum, {1});
  tum.tum_camera = 2;
  EXPECT_EQ(read_rgbd_frame(tum).camera.focal_y, 521.0);
  EXPECT_NEAR(read_rgbd_frame(files(RgbdFormat::nyu, {1})).camera.focal_x, 582.6245, 1e-4);
}

TEST_F(RgbdFrameFiles, IntrinsicsOfAFileSuitAnySize) {
  RgbdFiles sun = files(RgbdFormat::sun, {8}, 33, 20);
  sun.intrinsics = folder_.path() / "intrinsics.txt";
  for (const char* text : {"30.5 0 16 0 31.5 9.5 0 0 1 ", "30.5 0.0 16\n0 31.5 9.5\n0 0 1\n"}) {
    write_file(sun.intrinsics, text);
    const PinholeCamera camera = read_rgbd_frame(sun).camera;
    EXPECT_EQ(camera.focal_x, 30.5);
    EXPECT_EQ(camera.focal_y, 31.5);
    EXPECT_EQ(camera.centre_x, 16);
    EXPECT_EQ(camera.centre_y, 9.5);
  }
  write_file(sun.intrinsics, "30.5 0 16 0 31.5 9.5 0 0");
  EXPECT_THAT(message(sun), HasSubstr("intrinsics.txt: number 9 of 9 is missing"));
  write_file(sun.intrinsics, "0 0 16 0 31.5 9.5 0 0 1");
  EXPECT_THAT(message(sun), HasSubstr("is no camera's matrix"));
}

TEST_F(RgbdFrameFiles, SaysWhatIsWrong) {
  EXPECT_THAT(message(files(RgbdFormat::tum, {1}, 33, 20)), HasSubstr("is 33 x 20, the data set's camera 640 x 480"));
  RgbdFiles pair = files(RgbdFormat::redwood, {1});
  write_png(pair.colour, Image(320, 240, 3));
  EXPECT_THAT(message(pair), HasSubstr("colour.png: is 320 x 240, its depth 640 x 480"));
  write_png(pair.colour, Image(640, 480, 1));
  EXPECT_THAT(message(pair), HasSubstr("has 1 channels, not 3"));
  write_png(pair.depth, Image(640, 480, 1, 0.5f), PngCodes::plain8);
  EXPECT_THAT(message(pair), HasSubstr("depth.png: has 8 bits a pixel"));
  write_png(pair.depth, Image(640, 480, 3, 0.5f), PngCodes::plain16);
  EXPECT_THAT(message(pair), HasSubstr("has 3 channels, so it is no depth"));
  pair.depth = folder_.path() / "none.png";
  EXPECT_THAT(message(pair), HasSubstr("none.png: does not exist"));
  const RgbdFiles nyu = files(RgbdFormat::nyu, {741});
  write_file(nyu.depth, "P5 640 480 65535\nshort");
  EXPECT_THAT(message(nyu), HasSubstr("640 x 480 pixels need 614400 bytes, 5 follow"));
}

}  // namespace
}  // namespace partwise
