#include "partwise/normals/scenes/room.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/normals/scenes/room_picture.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/normal_measures.h"

namespace partwise {
namespace {

// A block of half a metre whose upper half is another part, and a flat one.
std::vector<Furniture> blocks() {
  std::vector<Furniture> result;
  for (const double height : {0.8, 0.1}) {
    Furniture block;
    block.mesh.vertices.resize(8, 3);
    for (int i = 0; i < 8; ++i) block.mesh.vertices.row(i) << 0.5 * (i % 2), height * (i / 2 % 2), 0.4 * (i / 4);
    block.mesh.faces.resize(12, 3);
    block.mesh.faces << 0, 5, 4, 0, 1, 5, 2, 7, 3, 2, 6, 7, 0, 3, 1, 0, 2, 3, 4, 7, 6, 4, 5, 7, 0, 6, 2, 0, 4, 6, 1, 7,
        5, 1, 3, 7;
    block.part_of_face = {0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};
    block.parts = 2;
    result.push_back(block);
  }
  return result;
}

Draw draw_for(int room) { return {5, static_cast<std::uint64_t>(room), 0}; }

TEST(Room, FurnitureStandsOnTheFloorApartAndWithinTheWalls) {
  int pieces = 0;
  for (int number = 0; number < 30; ++number) {
    Draw draw = draw_for(number);
    const Room room = drawn_room(blocks(), draw, {.least_pieces = 6, .most_pieces = 12});
    std::vector<Eigen::AlignedBox3d> boxes;
    int parts = first_furniture_part;
    for (std::size_t i = 1; i < room.meshes.size(); ++i) {
      const RenderMesh& piece = room.meshes[i];
      Eigen::AlignedBox3d box;
      for (const auto& vertex : piece.mesh.vertices.rowwise()) box.extend(Eigen::Vector3d(vertex.transpose()));
      EXPECT_NEAR(box.min().y(), 0, 1e-12);
      for (const int axis : {0, 2}) {
        EXPECT_GE(box.min()[axis], -room.size[axis] / 2 - 1e-9);
        EXPECT_LE(box.max()[axis], room.size[axis] / 2 + 1e-9);
      }
      for (const Eigen::AlignedBox3d& other : boxes) EXPECT_GT(box.exteriorDistance(other), 0);
      const Eigen::Vector3d viewer = room.camera.position.transpose();
      EXPECT_GE(box.exteriorDistance(Eigen::Vector3d(viewer.x(), box.min().y(), viewer.z())), 0.7 - 1e-9);
      EXPECT_EQ(*std::ranges::min_element(piece.parts), parts);
      EXPECT_EQ(*std::ranges::max_element(piece.parts), parts + 1);
      parts += 2;
      boxes.push_back(box);
    }
    EXPECT_EQ(room.parts, parts);
    pieces += static_cast<int>(boxes.size());
    Draw again = draw_for(number);
    EXPECT_EQ(drawn_room(blocks(), again, {.least_pieces = 6, .most_pieces = 12}).camera.position,
              room.camera.position);
  }
  EXPECT_GT(pieces, 30 * 5);
  Draw draw = draw_for(0);
  EXPECT_THROW(drawn_room(blocks(), draw, {.least_side = 0.5}), CheckFailed);
  EXPECT_THROW(drawn_room({Furniture{}}, draw), CheckFailed);
}

RoomWear all_of(int parts, const char* name) {
  return {{shipped_material(name).brdf.coefficients()}, std::vector<PartWear>(static_cast<std::size_t>(parts))};
}

// Where a ray from within leaves the room's box, in closed form: its depth and the normal there, in camera space.
TEST(RoomPicture, OfAnEmptyRoomIsThatOfItsBox) {
  for (int number = 0; number < 6; ++number) {
    Draw draw = draw_for(number);
    const Room room = drawn_room({}, draw);
    const RoomPictureSettings settings{.size = {80, 60, 1}, .map_size = 16};
    const EnvironmentLight light = shipped_light("studio").resized(32, 16);
    RoomWear wear = all_of(room.parts, "white-paint");
    wear.materials.resize(3, wear.materials[0]);
    wear.parts[ceiling_part].first = 1;
    wear.parts[wall_part].first = 2;
    const RoomPicture picture = room_picture(room, wear, light, settings);
    const PinholeCamera camera = pinhole_camera(room.camera, 80, 60);
    const Eigen::Vector3d from = room.camera.position.transpose();
    const Eigen::Vector3d low(-room.size.x() / 2, 0, -room.size.z() / 2), high = low + room.size;
    int seen[3] = {};
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) {
        const Eigen::Vector3d ray = room.camera.axes.transpose() * camera.ray(x, y);
        double depth = INFINITY;
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        int part = -1;
        for (int axis = 0; axis < 3; ++axis) {
          const double wall = ray[axis] > 0 ? high[axis] : low[axis], at = (wall - from[axis]) / ray[axis];
          if (!(at < depth)) continue;
          depth = at;
          normal = Eigen::Vector3d::Unit(axis) * (ray[axis] > 0 ? -1 : 1);
          part = axis != 1 ? wall_part : ray.y() > 0 ? ceiling_part : floor_part;  // and material
        }
        const Eigen::Vector3d expected = room.camera.axes * normal;
        const Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3f>(picture.normals.pixel(x, y)).cast<double>();
        ASSERT_NEAR(*picture.depth.pixel(x, y), depth, 1e-4 * depth);
        if (picture.materials[static_cast<std::size_t>(80 * y + x)] != part) continue;  // on an edge, to rounding
        ASSERT_LT((found - expected).norm(), 1e-4);
        ++seen[part];
      }
    }
    EXPECT_GT(seen[floor_part] + seen[wall_part] + seen[ceiling_part], 80 * 60 - 30);
    EXPECT_GT(seen[floor_part], 100);
  }
}

TEST(RoomPicture, NoisyNormalsErrAndMirrorsAreMissed) {
  Draw draw = draw_for(1);
  const Room room = drawn_room(blocks(), draw);
  const EnvironmentLight light = shipped_light("studio").resized(32, 16);
  const auto missing = [](const RoomPicture& picture) {
    return std::ranges::count(picture.sensed.values, 0.0f) / static_cast<double>(picture.sensed.values.size());
  };
  const RoomPicture dull = room_picture(room, all_of(room.parts, "white-paint"), light);
  NormalMeasure noisy;
  noisy.add(dull.noisy_normals, dull.normals, known_normals(dull.noisy_normals));
  const NormalErrors errors = noisy.errors();
  EXPECT_GT(errors.median, 0.1);
  EXPECT_LT(errors.median, 8);
  const RoomPicture mirrors = room_picture(room, all_of(room.parts, "chrome"), light);
  EXPECT_GT(missing(mirrors), missing(dull) + 0.3);
  EXPECT_LT(missing(dull), 0.35);
  EXPECT_TRUE(std::ranges::all_of(dull.image.values, [](float value) { return std::isfinite(value) && value >= 0; }));
  EXPECT_THROW(room_picture(room, all_of(1, "chrome"), light), CheckFailed);
}

}  // namespace
}  // namespace partwise
