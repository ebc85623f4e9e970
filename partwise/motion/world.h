// Obstacles made ready for motion among them: the scene that decides what is free, on the geometry as it was given, and
// the contact samples of its obstacles' nearly convex parts, which the field learns from.
//
//   a city     obstacles are footprints in the plane. With a tolerance (share of a footprint's radius) DuDe's parts are
//              obstacles of their own, so that hollows of a concave footprint have an axis; without one the field
//              learns from parts of tolerance 0.1
//   a mesh     obstacles are CoRiSE's parts of it (measure hull) to the tolerance (share of its radius), in space
//   a problem  any robot that a file describes. CoRiSE's parts of each of its meshes, or DuDe's of its footprints, are
//              obstacles; with `whole` each obstacle of the file stays one, and the field learns from its parts. The
//              robot's bodies are decomposed as well, for the samples alone
//
// Bounds are the bounding box, wider by `margin` times its diagonal, or the problem's (bounded_scene.h). Passages stay
// as they are, whatever the tolerance: it only moves contact samples, by as much as hulls stand out. Errors: InputError
// of decomposition and scenes.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "partwise/base/progress.h"
#include "partwise/geometry/mesh.h"
#include "partwise/motion/body_contacts.h"
#include "partwise/motion/city.h"
#include "partwise/motion/planning_problem.h"
#include "partwise/motion/scene.h"

namespace partwise {

struct WorldSettings {
  std::optional<double> tolerance;  // left out: whole footprints; 0.05 for meshes
  int contacts = 200;               // samples an obstacle
  double margin = 0.05;
};

struct ProblemWorldSettings {
  double tolerance = 0.05;  // share of the radius of each mesh or footprint
  bool whole = false;
  BodyContactSettings contacts;  // of a point, `samples` alone
};

struct World {
  std::shared_ptr<const Scene> scene;
  ContactSamples contacts;
};

// A problem's scene, and its contact samples for who asks for them, made anew each time: Minkowski sums take their
// time, and belong to what training a field costs.
struct ProblemScene {
  std::shared_ptr<const Scene> scene;
  std::function<ContactSamples(const Progress&)> contacts;
};

World city_world(const City& city, const WorldSettings& settings = {}, const Progress& progress = {});
World mesh_world(const Mesh& mesh, const WorldSettings& settings = {}, const Progress& progress = {});
World problem_world(const PlanningProblem& problem, const ProblemWorldSettings& settings = {},
                    const Progress& progress = {});
ProblemScene problem_scene(const PlanningProblem& problem, const ProblemWorldSettings& settings = {},
                           const Progress& progress = {});

}  // namespace partwise
