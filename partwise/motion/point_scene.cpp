#include "partwise/motion/point_scene.h"

#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/motion/obstacle_tree.h"

namespace partwise {
namespace {

void check(std::size_t obstacles) {
  if (obstacles == 0) throw InputError("scene", "holds no obstacle", "give at least one");
}

class PointScene : public Scene {
 public:
  PointScene(const ConfigurationSpace& space, const std::vector<std::vector<Simplex>>& boundaries)
      : Scene(space), tree_(boundaries) {}

  int obstacles() const override { return tree_.obstacles(); }

  Near distance(const Configuration& q, int obstacle) const override {
    return near(tree_.nearest(point(q), obstacle), q.size());
  }

  std::vector<Near> nearest(const Configuration& q, int count) const override {
    std::vector<Near> result;
    for (const NearestPoint& each : tree_.nearest_obstacles(point(q), count)) result.push_back(near(each, q.size()));
    return result;
  }

 protected:
  static Point point(const Configuration& q) { return {q[0], q[1], q.size() > 2 ? q[2] : 0.0}; }
  const ObstacleTree& tree() const { return tree_; }

 private:
  static Near near(const NearestPoint& found, Eigen::Index coordinates) {
    Near result{found.obstacle, found.distance, Tangent::Zero(coordinates)};
    if (found.distance > 0) result.gradient = (found.offset / found.distance).head(coordinates).transpose();
    return result;
  }

  ObstacleTree tree_;
};

bool inside_ring(const Ring& ring, const Point& p) {
  bool inside = false;
  for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
    if ((ring(i, 1) > p.y()) == (ring(j, 1) > p.y())) continue;
    const double x = ring(j, 0) + (p.y() - ring(j, 1)) / (ring(i, 1) - ring(j, 1)) * (ring(i, 0) - ring(j, 0));
    if (p.x() < x) inside = !inside;
  }
  return inside;
}

void add_sides(const Ring& ring, std::vector<Simplex>& sides) {
  for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
    const Point a(ring(j, 0), ring(j, 1), 0), b(ring(i, 0), ring(i, 1), 0);
    sides.push_back({a, b, b});
  }
}

std::vector<std::vector<Simplex>> sides_of(const std::vector<Polygons>& obstacles) {
  check(obstacles.size());
  std::vector<std::vector<Simplex>> result;
  for (const Polygons& polygons : obstacles) {
    auto& sides = result.emplace_back();
    for (const Polygon& polygon : polygons) {
      add_sides(polygon.outer, sides);
      for (const Ring& hole : polygon.holes) add_sides(hole, sides);
    }
    if (sides.empty()) throw InputError("scene", "an obstacle has no side", "leave out empty polygons");
  }
  return result;
}

class PlaneScene final : public PointScene {
 public:
  PlaneScene(const ConfigurationSpace& space, const std::vector<Polygons>& obstacles)
      : PointScene(space, sides_of(obstacles)), obstacles_(obstacles) {}

  int collision(const Configuration& q) const override {
    const Point p = point(q);
    for (const int obstacle : tree().boxes_around(p)) {
      if (inside(p, obstacle) || tree().nearest(p, obstacle).distance == 0) return obstacle;
    }
    return -1;
  }

 private:
  bool inside(const Point& p, int obstacle) const {
    bool inside = false;
    for (const Polygon& polygon : obstacles_[static_cast<std::size_t>(obstacle)]) {
      inside ^= inside_ring(polygon.outer, p);
      for (const Ring& hole : polygon.holes) inside ^= inside_ring(hole, p);
    }
    return inside;
  }

  std::vector<Polygons> obstacles_;
};

std::vector<std::vector<Simplex>> triangles_of(const std::vector<Mesh>& obstacles) {
  check(obstacles.size());
  std::vector<std::vector<Simplex>> result;
  for (const Mesh& mesh : obstacles) {
    auto& triangles = result.emplace_back();
    for (const auto& face : mesh.faces.rowwise())
      triangles.push_back({mesh.vertices.row(face[0]), mesh.vertices.row(face[1]), mesh.vertices.row(face[2])});
    if (triangles.empty()) throw InputError("scene", "an obstacle has no face", "leave out empty meshes");
  }
  return result;
}

class MeshScene final : public PointScene {
 public:
  MeshScene(const ConfigurationSpace& space, const std::vector<Mesh>& obstacles, const Mesh& solid)
      : PointScene(space, triangles_of(obstacles)), solid_(solid) {}

  int collision(const Configuration& q) const override {
    const Point p = point(q);
    if (solid_.contains(p)) return tree().nearest_obstacles(p, 1).front().obstacle;
    for (const int obstacle : tree().boxes_around(p)) {
      if (tree().nearest(p, obstacle).distance == 0) return obstacle;
    }
    return -1;
  }

 private:
  SurfaceQuery solid_;
};

}  // namespace

std::unique_ptr<Scene> point_scene(const std::vector<Polygons>& obstacles, const Eigen::AlignedBox2d& bounds) {
  const auto lifted = [](const Eigen::Vector2d& corner) { return Eigen::Vector3d(corner.x(), corner.y(), 0); };
  const ConfigurationSpace space(SpaceKind::plane, {lifted(bounds.min()), lifted(bounds.max())});
  return std::make_unique<PlaneScene>(space, obstacles);
}

std::unique_ptr<Scene> point_scene(const std::vector<Mesh>& obstacles, const Mesh& solid,
                                   const Eigen::AlignedBox3d& bounds) {
  return std::make_unique<MeshScene>(ConfigurationSpace(SpaceKind::space, bounds), obstacles, solid);
}

}  // namespace partwise
