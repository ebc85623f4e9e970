// Bodies and rigid robots as Parasol's .env and .robot files list them. The conventions are those of open-ppl's readers
// (Body, MultiBody, Connection, DHParameters) and of the library of rotations that comes with it (EulerAngle):
//
//   transformation  x y z, then degrees about x, y and z, all about the fixed axes of the frame: R = Rz Ry Rx
//   body            FILE [-a(COM | SURFACE | NONE)] [-c(colour)] [-t(texture)], then its kind; a body that says nothing
//                   is fixed, and gives a transformation. COM, the default, moves the mean of the file's vertices to
//                   the origin, SURFACE only along x and z
//   connection      PARENT CHILD NonActuated, a transformation A, Denavit and Hartenberg's alpha a d theta (radians), a
//                   transformation B: the child's pose in its parent is A D B, with
//                   D = Rz(theta) translation(a, 0, d) Rx(alpha)
//
// Words are read in any case of letters. Errors: InputError with file and line.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/geometry/text_scanner.h"
#include "partwise/motion/planning_problem.h"

namespace partwise {

// What is said of a passive body, in the world's frame. Meshes lie in `folder` or below.
Mesh read_parasol_obstacle(TextScanner& scanner, const std::filesystem::path& folder);

struct ParasolRobot {
  SpaceKind kind = SpaceKind::se3;
  std::vector<Mesh> bodies;  // in the frame of its base
};

// From the number of bodies to the last connection.
ParasolRobot read_parasol_robot(TextScanner& scanner, const std::filesystem::path& folder);

}  // namespace partwise
