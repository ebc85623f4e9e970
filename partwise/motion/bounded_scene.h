// A scene with the bounds of a planning problem that are more than a box of the origin: a sphere, or ones that all of
// the robot has to stay in (Parasol's). Scene::room then is the distance of the nearest vertex of the robot's hull from
// the bounds, so that what is certified free by distances is certified to stay inside as well (free_motion.h).
// Distances and collisions are those of the scene within: bounds are no obstacles, and no axis lies between them and
// one.
#pragma once

#include <memory>

#include "partwise/motion/planning_problem.h"
#include "partwise/motion/scene.h"

namespace partwise {

// `scene` itself where the problem asks for nothing else.
std::unique_ptr<Scene> bounded_scene(std::unique_ptr<Scene> scene, const PlanningProblem& problem);

}  // namespace partwise
