#include "partwise/motion/body_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/geometry/topology.h"
#include "partwise/motion/box_tree.h"
#include "partwise/motion/insert_nearest.h"
#include "partwise/motion/mesh_proximity.h"

namespace partwise {
namespace {

using Box = BoxTree::Box;
constexpr double anywhere = std::numeric_limits<double>::infinity();

Box box_of(const Mesh& mesh) {
  Box box;
  for (const auto& face : mesh.faces.rowwise()) {
    for (const int vertex : face) box.extend(mesh.vertices.row(vertex).transpose());
  }
  return box;
}

// Around the box after the motion.
Box moved(const Box& box, const Eigen::Isometry3d& pose) {
  const Eigen::Vector3d centre = pose * box.center();
  const Eigen::Vector3d half = pose.linear().cwiseAbs() * box.sizes() / 2;
  return {centre - half, centre + half};
}

// A point of each connected piece of the surface.
std::vector<Eigen::Vector3d> piece_points(const Mesh& mesh) {
  const Mesh joined = weld(mesh);
  const Components pieces = face_components_by_vertex(joined);
  std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(pieces.count));
  for (Eigen::Index f = 0; f < joined.faces.rows(); ++f)
    points[static_cast<std::size_t>(pieces.label[static_cast<std::size_t>(f)])] =
        joined.vertices.row(joined.faces(f, 0)).transpose();
  return points;
}

void expect_faces(const std::vector<Mesh>& meshes, const char* what) {
  if (meshes.empty()) throw InputError("scene", fmt::format("holds no {}", what), "give at least one");
  for (const Mesh& mesh : meshes) {
    if (mesh.faces.rows() == 0)
      throw InputError("scene", fmt::format("a {} has no face", what), "leave out empty meshes");
  }
}

class BodyScene final : public Scene {
 public:
  BodyScene(const ConfigurationSpace& space, const std::vector<Mesh>& robot, const std::vector<Mesh>& obstacles,
            const Mesh& solid)
      : Scene(space), solid_(solid), solid_box_(box_of(solid)) {
    const double reach = solid_box_.diagonal().norm() + body_radius(SpaceKind::se3, robot);
    const double scale = proximity_scale(reach);
    std::vector<Box> boxes;
    for (const Mesh& mesh : obstacles) {
      obstacles_.push_back({ProximityMesh(mesh, scale), box_of(mesh), piece_points(mesh), std::nullopt});
      boxes.push_back(obstacles_.back().box);
    }
    boxes_ = BoxTree(std::move(boxes));
    for (const Mesh& mesh : robot) {
      Piece& body = bodies_.emplace_back(ProximityMesh(mesh, scale), box_of(mesh), piece_points(mesh), std::nullopt);
      if (is_watertight(weld(mesh))) body.inside.emplace(mesh);
    }
  }

  int obstacles() const override { return static_cast<int>(obstacles_.size()); }

  int collision(const Configuration& q) const override {
    const Placed at = placed(q);
    std::vector<int> near;
    boxes_.near(at.box, 0, [&](int number, double bound2) {
      near.push_back(number);
      return bound2;
    });
    std::ranges::sort(near);
    for (const int number : near) {
      if (touches(at, obstacle(number))) return number;
    }
    return in_solid(at) ? nearest(at, 1).front().obstacle : -1;
  }

  Near distance(const Configuration& q, int number) const override { return near(placed(q), number, anywhere).value(); }
  std::vector<Near> nearest(const Configuration& q, int count) const override { return nearest(placed(q), count); }

 private:
  struct Piece {
    ProximityMesh surface;
    Box box;
    std::vector<Eigen::Vector3d> points;  // one of each connected piece
    std::optional<SurfaceQuery> inside;   // of closed bodies
  };
  struct Placed {
    Eigen::Isometry3d pose;
    std::vector<Box> boxes;  // of the bodies
    Box box;
  };

  const Piece& obstacle(int number) const { return obstacles_[static_cast<std::size_t>(number)]; }

  Placed placed(const Configuration& q) const {
    Placed at{space().pose(q), {}, {}};
    for (const Piece& body : bodies_) {
      at.boxes.push_back(moved(body.box, at.pose));
      at.box.extend(at.boxes.back());
    }
    return at;
  }

  bool touches(const Placed& at, const Piece& obstacle) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (!at.boxes[i].intersects(obstacle.box)) continue;
      if (obstacle.surface.touches(bodies_[i].surface, at.pose)) return true;
      if (bodies_[i].inside && holds(bodies_[i], at.pose, obstacle)) return true;
    }
    return false;
  }

  // Whether a piece of the obstacle, which does not touch the body, lies inside of it.
  static bool holds(const Piece& body, const Eigen::Isometry3d& pose, const Piece& obstacle) {
    const Eigen::Isometry3d back = pose.inverse();
    return std::ranges::any_of(obstacle.points, [&](const Eigen::Vector3d& point) {
      const Eigen::Vector3d here = back * point;
      return body.box.contains(here) && body.inside->contains(here.transpose());
    });
  }

  // Whether a piece of the robot, which touches nothing, lies inside.
  bool in_solid(const Placed& at) const {
    return std::ranges::any_of(bodies_, [&](const Piece& body) {
      return std::ranges::any_of(body.points, [&](const Eigen::Vector3d& point) {
        const Eigen::Vector3d here = at.pose * point;
        return solid_box_.contains(here) && solid_.contains(here.transpose());
      });
    });
  }

  // Nothing unless nearer than `below`.
  std::optional<Near> near(const Placed& at, int number, double below) const {
    std::optional<ProximityMesh::Witness> best;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const double bound = best ? best->distance : below;
      if (obstacle(number).box.exteriorDistance(at.boxes[i]) >= bound) continue;
      if (const auto found = obstacle(number).surface.nearest(bodies_[i].surface, at.pose, bound)) best = found;
    }
    if (!best) return std::nullopt;
    Near result{number, best->distance, Tangent::Zero(space().degrees_of_freedom())};
    if (best->distance == 0) return result;
    const Eigen::Vector3d away = (best->there - best->here) / best->distance;
    const Eigen::Index positions = position_axes(space().kind());
    result.gradient.head(positions) = away.head(positions);
    if (!space().rotates()) return result;
    const Eigen::Vector3d moment = (best->there - at.pose.translation()).cross(away) / space().rotation_scale();
    result.gradient.tail(positions == 2 ? 1 : 3) = moment.tail(positions == 2 ? 1 : 3);
    return result;
  }

  std::vector<Near> nearest(const Placed& at, int count) const {
    constexpr double hair = 1e-12;  // equally near ones are still looked at, for the lower number wins
    std::vector<Near> found;
    const auto wanted = static_cast<std::size_t>(count);
    boxes_.near(at.box, anywhere, [&](int number, double bound2) {
      const bool full = found.size() == wanted;
      const double below = full ? std::nextafter((1 + hair) * found.back().distance, anywhere) : anywhere;
      const std::optional<Near> next = near(at, number, below);
      if (!next) return bound2;
      insert_nearest(found, *next, wanted);
      return found.size() == wanted ? found.back().distance * found.back().distance : bound2;
    });
    return found;
  }

  std::vector<Piece> bodies_, obstacles_;
  BoxTree boxes_;
  SurfaceQuery solid_;
  Box solid_box_;
};

}  // namespace

double body_radius(SpaceKind kind, const std::vector<Mesh>& robot) {
  double radius = 0;
  for (const Mesh& body : robot) {
    const auto used = body.vertices.leftCols(position_axes(kind));
    if (used.rows() > 0) radius = std::max(radius, used.rowwise().norm().maxCoeff());
  }
  return radius;
}

std::unique_ptr<Scene> body_scene(SpaceKind kind, const Eigen::AlignedBox3d& bounds, const std::vector<Mesh>& robot,
                                  const std::vector<Mesh>& obstacles, const Mesh& solid) {
  expect_faces(robot, "body of the robot");
  expect_faces(obstacles, "obstacle");
  return std::make_unique<BodyScene>(ConfigurationSpace(kind, bounds, body_radius(kind, robot)), robot, obstacles,
                                     solid);
}

}  // namespace partwise
