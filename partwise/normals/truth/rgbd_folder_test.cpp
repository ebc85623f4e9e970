#include "partwise/normals/truth/rgbd_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RgbdFolder : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& text = "") {
    std::filesystem::create_directories((at_ / name).parent_path());
    write_file(at_ / name, text);
  }

  // "colour depth" of each frame, within the folder.
  std::vector<std::string> pairs(RgbdFormat format) {
    std::vector<std::string> result;
    for (const RgbdFiles& each : find_rgbd_frames(at_)) {
      EXPECT_EQ(each.format, format);
      result.push_back(std::filesystem::relative(each.colour, at_).string() + " " +
                       std::filesystem::relative(each.depth, at_).string());
    }
    return result;
  }

  std::string message() {
    try {
      find_rgbd_frames(at_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "was read";
  }

  TestFolder folder_;
  std::filesystem::path at_ = folder_.path();
};

TEST_F(RgbdFolder, Sun) {
  put("image/a.jpg");
  put("depth/b.png");
  put("depth_bfx/b.png");
  put("intrinsics.txt");
  EXPECT_THAT(pairs(RgbdFormat::sun), ElementsAre("image/a.jpg depth/b.png"));
  EXPECT_EQ(find_rgbd_frames(at_)[0].intrinsics, at_ / "intrinsics.txt");
  put("depth/c.png");
  EXPECT_THAT(message(), HasSubstr("has 2 pictures in depth/ and 1 in image/"));
}

TEST_F(RgbdFolder, TumPairsByTheNearestTime) {
  at_ /= "rgbd_dataset_freiburg3_desk";
  put("rgb.txt", "# colour\n10.000 rgb/0.png\n10.031 rgb/1.png\n10.500 rgb/2.png\n");
  put("depth.txt", "# time file\n10.012 depth/0.png\n10.016 depth/1.png\n\n10.050 depth/2.png\n10.470 depth/3.png\n");
  EXPECT_THAT(pairs(RgbdFormat::tum),
              ElementsAre("rgb/0.png depth/0.png", "rgb/1.png depth/1.png", "rgb/1.png depth/2.png"));
  EXPECT_EQ(find_rgbd_frames(at_)[0].tum_camera, 3);
  put("rgb.txt", "# colour\nten rgb/0.png\n");
  EXPECT_THAT(message(), HasSubstr("rgb.txt:2: is not a time and a file"));
}

TEST_F(RgbdFolder, RedwoodPairsByNumber) {
  put("depth/00002.png");
  put("depth/00001.png");
  put("depth/00003-000033.png");
  put("color/00001.jpg");
  put("color/00002.jpg");
  put("color/00003-000047.jpg");
  put("color/00004.jpg");
  EXPECT_THAT(pairs(RgbdFormat::redwood),
              ElementsAre("color/00001.jpg depth/00001.png", "color/00002.jpg depth/00002.png",
                          "color/00003-000047.jpg depth/00003-000033.png"));
}

TEST_F(RgbdFolder, RedwoodsCameraMayLieBesideItsFolders) {
  put("depth/1.png");
  put("color/1.png");
  EXPECT_TRUE(find_rgbd_frames(at_)[0].intrinsics.empty());
  put("intrinsics.txt");
  EXPECT_EQ(find_rgbd_frames(at_)[0].intrinsics, at_ / "intrinsics.txt");
}

TEST_F(RgbdFolder, NyuPairsByTheNearestTime) {
  put("d-1294886360.238178-2738420418.pgm");
  put("d-1294886361.238178-2798420418.pgm");  // the colour for it was dropped
  put("r-1294886360.208451-2736601376.ppm");
  put("r-1294886360.243101-2738601376.ppm");
  put("a-1294886360.011596-2725146400.dump");
  put("INDEX.txt");
  EXPECT_THAT(pairs(RgbdFormat::nyu),
              ElementsAre("r-1294886360.243101-2738601376.ppm d-1294886360.238178-2738420418.pgm"));
}

TEST_F(RgbdFolder, PairsThatAreNamedByTheirDataSet) {
  put("NYU_depth.pgm");
  put("NYU_color.ppm");
  put("TUM_depth.png");
  put("SUN_depth.png");
  put("SUN_color.jpg");
  const std::vector<RgbdFiles> frames = find_rgbd_frames(at_);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].format, RgbdFormat::nyu);
  EXPECT_EQ(frames[1].format, RgbdFormat::sun);
  EXPECT_EQ(frames[1].colour, at_ / "SUN_color.jpg");
}

TEST_F(RgbdFolder, RefusesWhatIsNoDataSet) {
  put("holiday.jpg");
  EXPECT_THAT(message(), HasSubstr("holds no pair of colour and depth"));
  at_ /= "holiday.jpg";
  EXPECT_THAT(message(), HasSubstr("holiday.jpg: is no folder"));
}

}  // namespace
}  // namespace partwise
