#include "partwise/normals/scenes/room.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr int draws_for_a_place = 20;
constexpr double from_wall = 0.35;  // metres, of the camera
constexpr double kept_free = 0.7;   // metres about the camera

using Box = Eigen::AlignedBox2d;  // on the floor: x and z

RenderMesh box_of(const Eigen::Vector3d& size) {
  RenderMesh box;
  box.mesh.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    box.mesh.vertices.row(i) << (i % 2 == 0 ? -0.5 : 0.5) * size.x(), (i / 2 % 2 == 0 ? 0 : 1) * size.y(),
        (i / 4 == 0 ? -0.5 : 0.5) * size.z();
  }
  // Seen from within, counter-clockwise.
  box.mesh.faces.resize(12, 3);
  box.mesh.faces << 0, 4, 5, 0, 5, 1,  // floor
      2, 3, 7, 2, 7, 6,                // ceiling
      0, 1, 3, 0, 3, 2,                // back, -z
      4, 6, 7, 4, 7, 5,                // front
      0, 2, 6, 0, 6, 4,                // left
      1, 5, 7, 1, 7, 3;                // right
  box.parts = {floor_part, floor_part, ceiling_part, ceiling_part};
  box.parts.resize(12, wall_part);
  box.crease_degrees = 0;
  return box;
}

Camera camera_in(const Eigen::Vector3d& size, Draw& draw, double field_of_view) {
  // Near one of the four walls, anywhere along it.
  const int wall = draw.below(4);
  const Eigen::Vector2d half(size.x() / 2 - from_wall, size.z() / 2 - from_wall);
  const double along = draw.within(-1, 1), side = wall % 2 == 0 ? 1 : -1;
  const Eigen::Vector2d at = wall < 2 ? Eigen::Vector2d(side * half.x(), along * half.y())
                                      : Eigen::Vector2d(along * half.x(), side * half.y());
  const double turn = draw.within(-25, 25), down = draw.within(5, 25);
  Camera camera;
  camera.position = Point(at.x(), draw.within(1.1, 1.7), at.y());
  // The back axis points from the middle of the room to the camera.
  const double azimuth = std::atan2(at.x(), at.y()) + turn * radians;
  camera.axes = (Eigen::AngleAxisd(azimuth, Eigen::Vector3d::UnitY()) *
                 Eigen::AngleAxisd(-down * radians, Eigen::Vector3d::UnitX()))
                    .toRotationMatrix()
                    .transpose();
  camera.half_height = std::tan(field_of_view * radians / 2);
  return camera;
}

// Turned, with its foot at y = 0 and the middle of its box over the origin.
Mesh standing(Mesh mesh, double turn) {
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()).toRotationMatrix();
  mesh.vertices = (mesh.vertices * rotation.transpose()).eval();
  const Point low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  const Point foot((low.x() + high.x()) / 2, low.y(), (low.z() + high.z()) / 2);
  mesh.vertices.rowwise() -= foot;
  return mesh;
}

Box box_on_floor(const Mesh& mesh) {
  const Point low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  return {Eigen::Vector2d(low.x(), low.z()), Eigen::Vector2d(high.x(), high.z())};
}

}  // namespace

Room drawn_room(const std::vector<Furniture>& furniture, Draw& draw, const RoomSettings& settings) {
  PARTWISE_CHECK(settings.least_side, >, 2 * from_wall);
  PARTWISE_CHECK(settings.most_side, >=, settings.least_side);
  PARTWISE_CHECK(settings.least_height, >, 1.7);
  PARTWISE_CHECK(settings.most_height, >=, settings.least_height);
  PARTWISE_CHECK(settings.least_pieces, >=, 0);
  PARTWISE_CHECK(settings.most_pieces, >=, settings.least_pieces);
  PARTWISE_CHECK(settings.field_of_view, >, 0);
  PARTWISE_CHECK(settings.field_of_view, <, 180);
  const auto side = [&] { return draw.within(settings.least_side, settings.most_side); };
  Room room;
  room.size.x() = side();
  room.size.y() = draw.within(settings.least_height, settings.most_height);
  room.size.z() = side();
  room.meshes.push_back(box_of(room.size));
  room.parts = first_furniture_part;
  room.camera = camera_in(room.size, draw, settings.field_of_view);

  const Eigen::Vector2d viewer(room.camera.position.x(), room.camera.position.z());
  std::vector<Box> taken{Box(viewer.array() - kept_free, viewer.array() + kept_free)};
  const int pieces = settings.least_pieces + draw.below(settings.most_pieces - settings.least_pieces + 1);
  for (int piece = 0; piece < pieces && !furniture.empty(); ++piece) {
    const Furniture& model = furniture[static_cast<std::size_t>(draw.below(static_cast<int>(furniture.size())))];
    PARTWISE_CHECK(model.mesh.faces.rows(), >, 0);
    PARTWISE_CHECK(std::ssize(model.part_of_face), ==, model.mesh.faces.rows());
    Mesh mesh = standing(model.mesh, 2 * std::numbers::pi * draw.unit());
    const Box foot = box_on_floor(mesh);
    const Eigen::Vector2d reach = Eigen::Vector2d(room.size.x(), room.size.z()) / 2 - foot.sizes() / 2;
    if (reach.minCoeff() < 0 || mesh.vertices.col(1).maxCoeff() > room.size.y()) continue;
    for (int i = 0; i < draws_for_a_place; ++i) {
      const double x = draw.within(-reach.x(), reach.x()), z = draw.within(-reach.y(), reach.y());
      const Box place = foot.translated(Eigen::Vector2d(x, z));
      if (std::ranges::any_of(taken, [&](const Box& other) { return other.intersects(place); })) continue;
      taken.push_back(place);
      mesh.vertices.rowwise() += Point(x, 0, z);
      RenderMesh placed{std::move(mesh), model.part_of_face};
      for (int& part : placed.parts) part += room.parts;
      room.parts += model.parts;
      room.meshes.push_back(std::move(placed));
      break;
    }
  }
  return room;
}

}  // namespace partwise
