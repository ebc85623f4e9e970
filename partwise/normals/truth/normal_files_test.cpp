#include "partwise/normals/truth/normal_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/png.h"
#include "partwise/normals/truth/test_depths.h"

namespace partwise {
namespace {

using Eigen::Vector3d;
using test::degrees_between;
using test::normal_at;

constexpr int side = 49, middle = 24;

// Where the sphere of data/golden/sphere_normals.png is seen: it fills 0.8 of the frame. Zero beside it.
Vector3d sphere_normal(int x, int y) {
  const double nx = 1.25 * ((2 * x + 1.0) / side - 1), ny = 1.25 * (1 - (2 * y + 1.0) / side);
  const double square = nx * nx + ny * ny;
  return square < 1 ? Vector3d(nx, ny, std::sqrt(1 - square)) : Vector3d::Zero();
}

Image sphere() {
  Image image(side, side, 3);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      Eigen::Map<Eigen::Vector3f>(image.pixel(x, y)) = sphere_normal(x, y).cast<float>();
    }
  }
  return image;
}

class NormalFiles : public testing::TestWithParam<std::string> {
 protected:
  std::filesystem::path write(const Image& normals) {
    const std::filesystem::path path = folder_.path() / ("a" + GetParam().substr(GetParam().find('.')));
    write_normals(path, normals, GetParam().starts_with("8") ? NormalBits::eight : NormalBits::sixteen);
    return path;
  }
  double precision() const { return GetParam() == "8.png" ? 0.4 : GetParam() == "16.png" ? 2e-3 : 1e-4; }  // degrees

  TestFolder folder_;
};

TEST_P(NormalFiles, ASphereLooksLeftRightUpDownAndAtTheCamera) {
  const Image back = read_normals(write(sphere()));
  const int near = 5, far = side - 1 - near;
  EXPECT_LT(normal_at(back, near, middle).x(), -0.9);
  EXPECT_GT(normal_at(back, far, middle).x(), 0.9);
  EXPECT_GT(normal_at(back, middle, near).y(), 0.9);
  EXPECT_LT(normal_at(back, middle, far).y(), -0.9);
  EXPECT_GT(normal_at(back, middle, middle).z(), 0.9999);
}

TEST_P(NormalFiles, NormalsComeBack) {
  const Image back = read_normals(write(sphere()));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vector3d truth = sphere_normal(x, y), found = normal_at(back, x, y);
      if (truth.isZero()) {
        EXPECT_TRUE(found.isZero()) << x << ' ' << y;
      } else {
        EXPECT_LT(degrees_between(found, truth), precision()) << x << ' ' << y;
        EXPECT_NEAR(found.norm(), 1, 1e-6);
      }
    }
  }
}

std::string name_of(const testing::TestParamInfo<std::string>& format) {
  return format.param == "8.png" ? "Png8" : format.param == "16.png" ? "Png16" : "Exr";
}

INSTANTIATE_TEST_SUITE_P(Formats, NormalFiles, testing::Values("8.png", "16.png", ".exr"), name_of);

TEST(NormalFilesOnDisk, HoldTheCodesOfTheConvention) {
  const TestFolder folder;
  Image image(4, 1, 3);
  image.values = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};  // right, up, to the camera, none
  write_normals(folder.path() / "a.png", image, NormalBits::eight);
  const auto code8 = [](int code) { return static_cast<float>(code * 257) / 65535; };
  EXPECT_THAT(read_plain_png(folder.path() / "a.png").values,
              testing::ElementsAre(code8(255), code8(128), code8(128), code8(128), code8(255), code8(128), code8(128),
                                   code8(128), code8(255), code8(128), code8(128), code8(128)));
  write_normals(folder.path() / "a.png", image);
  const float none = 32768.0f / 65535;
  EXPECT_THAT(read_plain_png(folder.path() / "a.png").values,
              testing::ElementsAre(1, none, none, none, 1, none, none, none, 1, none, none, none));
  write_normals(folder.path() / "a.EXR", image);
  EXPECT_EQ(read_exr(folder.path() / "a.EXR", std::array<std::string, 3>{"X", "Y", "Z"}).values, image.values);
}

TEST(NormalFilesOnDisk, TheGoldenSphereIsReadAsIsTold) {
  const Image golden = read_normals(std::filesystem::path(PARTWISE_TEST_DATA) / "data/golden/sphere_normals.png");
  int compared = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (sphere_normal(x, y).z() < 0.3) continue;
      ++compared;
      EXPECT_LT(degrees_between(normal_at(golden, x, y), sphere_normal(x, y)), 0.5) << x << ' ' << y;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(NormalFilesOnDisk, RefuseWhatHoldsNoNormals) {
  const TestFolder folder;
  const auto message = [](const std::filesystem::path& path) {
    try {
      read_normals(path);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  write_png(folder.path() / "grey.png", Image(2, 2, 1));
  EXPECT_THAT(message(folder.path() / "grey.png"), testing::HasSubstr("grey.png: has 1 channels, not 3; "));
  write_exr(folder.path() / "rgb.exr", Image(2, 2, 3));
  EXPECT_THAT(message(folder.path() / "rgb.exr"), testing::HasSubstr("rgb.exr"));
  EXPECT_THAT(message(folder.path() / "a.jpg"), testing::HasSubstr("a.jpg: has the ending of no file of normals; "));
  EXPECT_THROW(write_normals(folder.path() / "a.tiff", Image(2, 2, 3)), InputError);
}

}  // namespace
}  // namespace partwise
