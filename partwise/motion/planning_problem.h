// A motion planning problem as a file tells it: a rigid robot, obstacles, where the robot may be, and where it should
// go. docs/problems.md describes the formats, which the ending chooses, in any case of letters:
//
//   .cfg   OMPL.app's, with the meshes that it names beside it
//   .env   Parasol's (open-ppl), with its robot in it or in a .robot file, and queries in a .query file
//   .json  Partwise's own
//
// Lengths are in the unit of the file, angles in radians, configurations as configuration_space.h has them. Bodies are
// given in the robot's frame, which is the world's where the configuration is the identity; obstacles in the world's.
// What the formats do to meshes is done: Parasol moves the mean of a body's vertices to its origin unless told
// otherwise, OMPL.app the robot's centre. Meshes are neither repaired nor joined.
//
// Robots are rigid: one body, or several joined by fixed joints. Errors: InputError, one line with file and line or
// place, for files that are missing, malformed or cut short, worlds without obstacles, bounds without room, starts and
// goals outside them, and what is not supported: joints that move, several robots, COLLADA meshes, motion under
// differential constraints.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"
#include "partwise/motion/configuration_space.h"

namespace partwise {

struct MotionQuery {
  Configuration start, goal;
};

struct PlanningProblem {
  std::string name;
  SpaceKind kind = SpaceKind::se3;
  std::vector<Mesh> robot;           // its bodies; none: a point
  std::vector<Mesh> obstacles;       // one a body of the file
  std::vector<Polygons> footprints;  // the obstacles of a point in the plane, instead of meshes
  Eigen::AlignedBox3d bounds;        // in the plane only x and y count, z is 0
  std::optional<Sphere> sphere;      // where the bounds are one; `bounds` is then the box around it
  bool bounds_hold_body = false;     // all of the robot stays within the bounds, not its origin alone (Parasol's)
  std::vector<MotionQuery> queries;  // may be none, for a roadmap
};

// The other files of an .env; empty: those of the same stem beside it, else the only ones of their ending there.
struct ProblemFiles {
  std::filesystem::path robot, query;
};

PlanningProblem read_planning_problem(const std::filesystem::path& path, const ProblemFiles& files = {});

// How deep a point lies within box and sphere; negative outside. In the plane z does not count.
double depth_within(const Eigen::AlignedBox3d& bounds, const std::optional<Sphere>& sphere, SpaceKind kind,
                    const Eigen::Vector3d& point);

// Whether the robot's origin, or all of its vertices where the bounds hold the body, lies within box and sphere, but
// for rounding (1e-9 of the box's diagonal).
bool within_bounds(const PlanningProblem& problem, const Configuration& q);

// For problems that a program puts together.

// Bounds for where none are asked for: the box of the obstacles, wider by 5 % of its diagonal on each side.
Eigen::AlignedBox3d usual_bounds(const PlanningProblem& problem);

// `numbers` are the coordinates of the space, an angle of any size, a quaternion within 1e-3 of unit length. Errors:
// InputError at `place` for another count, numbers that are not finite, or another length.
Configuration configuration_of(SpaceKind kind, std::span<const double> numbers, const std::string& place);

// Throws InputError at "robot", "obstacles", "bounds" or "queries[0].start", say, for what no file may ask for either:
// a robot without a body that turns, or that goes among meshes in the plane; footprints for another robot than a point
// in the plane; no obstacles; bounds without room; starts and goals outside of them.
void check_problem(const PlanningProblem& problem);

}  // namespace partwise
