#include "partwise/normals/scenes/room_wear.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/normals/scenes/room.h"
#include "partwise/normals/scenes/room_picture.h"

namespace partwise {
namespace {

DsbrdfCoefficients coefficients(const char* name) { return shipped_material(name).brdf.coefficients(); }

// How often the material changes along a line of 10 m.
int changes(const PartWear& wear, const Eigen::Vector3d& direction) {
  int count = 0, before = wear.material(Eigen::Vector3d::Zero());
  for (int i = 1; i <= 100000; ++i) {
    const int now = wear.material(direction * (i * 1e-4));
    count += now != before ? 1 : 0;
    before = now;
  }
  return count;
}

TEST(PartWear, PatternsAreAsLargeAsTheySay) {
  PartWear wear{.first = 2, .second = 5, .pattern = Pattern::stripes, .size = 0.25, .seed = 17};
  EXPECT_EQ(changes(wear, Eigen::Vector3d::UnitX()), 40);
  EXPECT_EQ(changes(wear, Eigen::Vector3d::UnitY()), 0);
  wear.pattern = Pattern::checks;
  for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(changes(wear, Eigen::Vector3d::Unit(axis)), 40);
  wear.pattern = Pattern::plain;
  EXPECT_EQ(changes(wear, Eigen::Vector3d::UnitX()), 0);
  EXPECT_EQ(wear.material(Eigen::Vector3d(1, 2, 3)), 2);
}

TEST(PartWear, BlotsAreHalfOfEither) {
  const PartWear wear{.first = 0, .second = 1, .pattern = Pattern::blots, .size = 0.1, .seed = 3};
  int second = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) second += wear.material({0.037 * i, 0.041 * j, 0.013 * (i + j)});
  EXPECT_NEAR(second / 1600.0, 0.5, 0.1);
  const int found = changes(wear, Eigen::Vector3d::UnitZ());
  EXPECT_GT(found, 20);
  EXPECT_LT(found, 110);
}

TEST(RoomWear, MirrorsLoseTheSensor) {
  EXPECT_EQ(mirror_share(coefficients("white-fabric")), 0);
  EXPECT_GT(mirror_share(coefficients("chrome")), 0.8);
}

TEST(RoomWear, IsDrawnFromFewMaterialsAndWallsAreDull) {
  std::vector<DsbrdfCoefficients> all;
  for (const char* name : {"chrome", "white-fabric", "steel", "nylon", "brass", "pink-felt"})
    all.push_back(coefficients(name));
  for (std::uint64_t number = 0; number < 20; ++number) {
    Draw draw(1, number, 0);
    const DrawnWear wear = drawn_wear(12, all, draw, {.materials = 4});
    ASSERT_EQ(wear.materials.size(), 4u);
    EXPECT_EQ(std::set<int>(wear.chosen.begin(), wear.chosen.end()).size(), 4u);
    std::vector<double> mirrors;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(wear.materials[i], all[static_cast<std::size_t>(wear.chosen[i])]);
      mirrors.push_back(mirror_share(wear.materials[i]));
    }
    std::vector<double> sorted = mirrors;
    std::ranges::sort(sorted);
    ASSERT_EQ(wear.parts.size(), 12u);
    for (int part = 0; part < first_furniture_part; ++part)
      for (const int each :
           {wear.parts[static_cast<std::size_t>(part)].first, wear.parts[static_cast<std::size_t>(part)].second})
        EXPECT_LE(mirrors[static_cast<std::size_t>(each)], sorted[1]);
    Draw again(1, number, 0);
    EXPECT_EQ(drawn_wear(12, all, again, {.materials = 4}).parts[11].size, wear.parts[11].size);
  }
  Draw draw(1, 0, 0);
  EXPECT_THROW(drawn_wear(3, {}, draw), CheckFailed);
  EXPECT_THROW(drawn_wear(3, all, draw, {.least_size = 0}), CheckFailed);
}

// On the walls of an empty room, whose points are known from the depth.
TEST(RoomWear, IsWhatPixelsShow) {
  Draw draw(2, 0, 0);
  const Room room = drawn_room({}, draw);
  RoomWear wear{{coefficients("pink-felt"), coefficients("nylon")}, std::vector<PartWear>(3)};
  for (PartWear& part : wear.parts) part = {.first = 0, .second = 1, .pattern = Pattern::checks, .size = 0.4};
  const RoomPicture picture = room_picture(room, wear, shipped_light("studio").resized(32, 16), {.map_size = 16});
  const PinholeCamera camera = pinhole_camera(room.camera, 160, 120);
  int second = 0, other = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Eigen::Vector3d point =
          room.camera.position.transpose() +
          static_cast<double>(*picture.depth.pixel(x, y)) * (room.camera.axes.transpose() * camera.ray(x, y));
      const int shown = picture.materials[static_cast<std::size_t>(160 * y + x)];
      second += shown;
      other += shown != wear.parts[0].material(point) ? 1 : 0;
    }
  }
  EXPECT_GT(second, 19200 / 4);
  EXPECT_LT(second, 3 * 19200 / 4);
  EXPECT_LT(other, 20);  // on the line between two, to rounding
}

}  // namespace
}  // namespace partwise
