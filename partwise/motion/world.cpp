#include "partwise/motion/world.h"

#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/motion/body_scene.h"
#include "partwise/motion/bounded_scene.h"
#include "partwise/motion/obstacle_parts.h"
#include "partwise/motion/point_scene.h"

namespace partwise {
namespace {

constexpr double whole_planar_tolerance = 0.1, solid_tolerance = 0.05;

template <typename Box>
Box wider(const Box& box, double margin) {
  Box result = box;
  const double by = margin * box.diagonal().norm();
  result.min().array() -= by;
  result.max().array() += by;
  return result;
}

World planar_world(const PlanarParts& parts, const Eigen::AlignedBox2d& bounds, int contacts) {
  return {point_scene(parts.obstacles, bounds), contact_samples(parts.hulls, parts.owners, contacts)};
}

}  // namespace

World city_world(const City& city, const WorldSettings& settings, const Progress& progress) {
  const double tolerance = settings.tolerance.value_or(whole_planar_tolerance);
  const PlanarParts parts = planar_parts(city.footprints, tolerance, !settings.tolerance, progress);
  Eigen::AlignedBox2d box;
  for (const Polygons& each : parts.obstacles) box.extend(bounding_box(each));
  return planar_world(parts, wider(box, settings.margin), settings.contacts);
}

World mesh_world(const Mesh& mesh, const WorldSettings& settings, const Progress& progress) {
  const SolidParts parts = solid_parts({mesh}, settings.tolerance.value_or(solid_tolerance), false, progress);
  Eigen::AlignedBox3d box;
  for (const Mesh& hull : parts.hulls) {
    for (const auto& vertex : hull.vertices.rowwise()) box.extend(vertex.transpose());
  }
  return {point_scene(parts.obstacles, parts.solid, wider(box, settings.margin)),
          contact_samples(parts.hulls, parts.owners, settings.contacts)};
}

ProblemScene problem_scene(const PlanningProblem& problem, const ProblemWorldSettings& settings,
                           const Progress& progress) {
  if (!problem.footprints.empty()) {
    PARTWISE_CHECK(problem.robot.size(), ==, 0u);  // footprints are a point's
    const auto parts = std::make_shared<const PlanarParts>(
        planar_parts(problem.footprints, settings.tolerance, settings.whole, progress));
    const Eigen::AlignedBox2d bounds(problem.bounds.min().head<2>(), problem.bounds.max().head<2>());
    return {bounded_scene(point_scene(parts->obstacles, bounds), problem),
            [parts, each = settings.contacts.samples](const Progress&) {
              return contact_samples(parts->hulls, parts->owners, each);
            }};
  }
  const auto parts =
      std::make_shared<const SolidParts>(solid_parts(problem.obstacles, settings.tolerance, settings.whole, progress));
  if (problem.robot.empty()) {
    if (problem.kind != SpaceKind::space)
      throw InputError(problem.name, "has a point among meshes for a robot, outside of space",
                       "give the robot a body, or plan in space");
    return {bounded_scene(point_scene(parts->obstacles, parts->solid, problem.bounds), problem),
            [parts, each = settings.contacts.samples](const Progress&) {
              return contact_samples(parts->hulls, parts->owners, each);
            }};
  }
  const std::vector<Mesh> bodies = solid_parts(problem.robot, settings.tolerance, true, progress).hulls;
  std::shared_ptr<const Scene> scene =
      bounded_scene(body_scene(problem.kind, problem.bounds, problem.robot, parts->obstacles, parts->solid), problem);
  const ConfigurationSpace space = scene->space();
  return {std::move(scene), [parts, bodies, space, contacts = settings.contacts](const Progress& making) {
            return body_contacts(space, bodies, parts->hulls, parts->owners, contacts, making);
          }};
}

World problem_world(const PlanningProblem& problem, const ProblemWorldSettings& settings, const Progress& progress) {
  const ProblemScene made = problem_scene(problem, settings, progress);
  return {made.scene, made.contacts(progress)};
}

}  // namespace partwise
