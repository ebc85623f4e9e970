#include "motion_pictures/path_scene.h"

#include <fmt/format.h>

#include "motion_pictures/roadmap_pictures.h"
#include "partwise/appearance/palette.h"
#include "partwise/geometry/extrude.h"

namespace partwise {
namespace {

constexpr int places = 24;
const Eigen::Vector3f grey(0.55f, 0.55f, 0.52f);

Mesh moved(Mesh mesh, const Eigen::Isometry3d& pose) {
  mesh.vertices = (mesh.vertices * pose.linear().transpose()).eval();
  mesh.vertices.rowwise() += pose.translation().transpose();
  return mesh;
}

std::vector<Mesh> obstacle_meshes(const PlanningProblem& problem) {
  std::vector<Mesh> meshes = problem.obstacles;
  const double height = 0.01 * problem.bounds.diagonal().norm();
  for (const Polygons& polygons : problem.footprints) {
    for (const Polygon& polygon : polygons) meshes.push_back(prism(polygon, 0, height));
  }
  return meshes;
}

}  // namespace

std::vector<NamedMesh> path_scene(const PlanningProblem& problem, const ConfigurationSpace& space,
                                  const MotionPath& found) {
  std::vector<NamedMesh> meshes;
  for (Mesh& each : obstacle_meshes(problem)) meshes.push_back({"obstacle", std::move(each), grey});
  for (int i = 0; i < places && !problem.robot.empty(); ++i) {
    const double share = static_cast<double>(i) / (places - 1);
    const Eigen::Isometry3d pose = space.pose(path_at(space, found, share));
    for (const Mesh& body : problem.robot)
      meshes.push_back({fmt::format("robot {}", i), moved(body, pose), value_colour(static_cast<float>(share))});
  }
  std::vector<Eigen::Vector3d> way;
  for (const Configuration& q : found.configurations) way.push_back(space.pose(q).translation());
  meshes.push_back({"path", tube_along(way, 0.0008 * problem.bounds.diagonal().norm()), value_colour(0.8f)});
  return meshes;
}

}  // namespace partwise
