#include "partwise/motion/bounded_scene.h"

#include <algorithm>
#include <utility>

#include "partwise/geometry/convex_hull.h"

namespace partwise {
namespace {

// The vertices that bodies stand out with most.
std::vector<Eigen::Vector3d> corners_of(const std::vector<Mesh>& robot) {
  std::vector<Eigen::Vector3d> corners;
  for (const Mesh& body : robot) {
    if (body.vertices.rows() == 0) continue;
    const double size = (body.vertices.colwise().maxCoeff() - body.vertices.colwise().minCoeff()).norm();
    for (const int vertex : convex_hull(body.vertices, std::max(1e-9 * size, 1e-300)).source)
      corners.emplace_back(body.vertices.row(vertex).transpose());
  }
  return corners;
}

class BoundedScene final : public Scene {
 public:
  BoundedScene(std::unique_ptr<Scene> scene, const PlanningProblem& problem)
      : Scene(scene->space()),
        scene_(std::move(scene)),
        sphere_(problem.sphere),
        holds_body_(problem.bounds_hold_body && !problem.robot.empty()) {
    if (holds_body_) corners_ = corners_of(problem.robot);
  }

  int obstacles() const override { return scene_->obstacles(); }
  int collision(const Configuration& q) const override { return scene_->collision(q); }
  Near distance(const Configuration& q, int obstacle) const override { return scene_->distance(q, obstacle); }
  std::vector<Near> nearest(const Configuration& q, int count) const override { return scene_->nearest(q, count); }

  double room(const Configuration& q) const override {
    constexpr double anywhere = std::numeric_limits<double>::infinity();
    const Eigen::Isometry3d pose = space().pose(q);
    if (!holds_body_) return depth(pose.translation()) >= 0 ? anywhere : 0;
    double least = anywhere;
    for (const Eigen::Vector3d& corner : corners_) least = std::min(least, depth(pose * corner));
    return std::max(least, 0.0);
  }

 private:
  double depth(const Eigen::Vector3d& point) const {
    return depth_within(space().bounds(), sphere_, space().kind(), point);
  }

  std::unique_ptr<Scene> scene_;
  std::optional<Sphere> sphere_;
  bool holds_body_;
  std::vector<Eigen::Vector3d> corners_;
};

}  // namespace

std::unique_ptr<Scene> bounded_scene(std::unique_ptr<Scene> scene, const PlanningProblem& problem) {
  const bool plain = !problem.sphere && (!problem.bounds_hold_body || problem.robot.empty());
  return plain ? std::move(scene) : std::make_unique<BoundedScene>(std::move(scene), problem);
}

}  // namespace partwise
