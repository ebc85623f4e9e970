// A decomposed body for physics engines: URDF (ROS, Drake, Bullet) and MJCF (MuJoCo), one collision geometry a hull.
//
// Model units are taken as metres. The hulls are written as OBJ files into the folder <stem>_hulls beside the file and
// named relative to it: body.urdf refers to body_hulls/hull_000.obj. What is drawn is body_hulls/visual.obj if `visual`
// is given, else the hulls. Two files of one stem, a URDF and an MJCF, share the folder. The XML is written last, so
// that it never names a file that is not there; an older folder's further hulls stay, unnamed.
//
// URDF: one link with inertial, visual and collision elements. MJCF: one body with a free joint, an inertial and one
// geom a hull; a drawn mesh is a geom that collides with nothing. Sources: the URDF specification of ROS
// (wiki.ros.org/urdf/XML/link), MuJoCo's XML reference. Errors: InputError when there are no hulls, when density, mass
// or inertia is none of a rigid body (see is_physical), or when a file cannot be written.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "partwise/geometry/mass.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

struct RobotBody {
  std::string_view name;         // of the robot or model, the link or body
  std::span<const Mesh> hulls;   // closed and convex
  const Mesh* visual = nullptr;  // what is drawn; null for the hulls
  MassProperties mass;           // at unit density, see body_mass
  double density = 1000;         // kg / m^3
};

// The mass of the mesh if it is closed and that of a rigid body; else of the hulls together, where overlaps count
// twice.
MassProperties body_mass(const Mesh& mesh, std::span<const Mesh> hulls);

void write_urdf(const std::filesystem::path& path, const RobotBody& body);
void write_mjcf(const std::filesystem::path& path, const RobotBody& body);

}  // namespace partwise
