#include "partwise/parts/solid/robot_files.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

// Text inside an attribute. XML 1.0 has no way to write control characters, so they become blanks.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return result;
}

std::string hull_name(std::size_t i) { return fmt::format("hull_{:03}", i); }

std::string folder_name(const std::filesystem::path& path) { return path.stem().string() + "_hulls"; }

void check(const std::filesystem::path& path, const RobotBody& body) {
  if (body.hulls.empty()) throw InputError(path.string(), "the body has no hulls", "decompose a mesh first");
  if (!(body.density > 0) || !std::isfinite(body.density)) {
    throw InputError("density", fmt::format("is {}", body.density), "give a positive number of kg / m^3");
  }
  if (!is_physical(body.mass)) {
    throw InputError(path.string(), "no rigid body has this mass and inertia",
                     "give those of a closed mesh that does not cross itself, or of the hulls");
  }
}

void write_meshes_beside(const std::filesystem::path& path, const RobotBody& body) {
  const std::filesystem::path folder = path.parent_path() / folder_name(path);
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string(), fmt::format("cannot be made a folder ({})", error.message()),
                     "name a file in a folder that exists and that you may write to");
  }
  for (std::size_t i = 0; i < body.hulls.size(); ++i) write_mesh(folder / (hull_name(i) + ".obj"), body.hulls[i]);
  if (body.visual) write_mesh(folder / "visual.obj", *body.visual);
}

}  // namespace

MassProperties body_mass(const Mesh& mesh, std::span<const Mesh> hulls) {
  if (is_watertight(mesh)) {
    try {
      MassProperties own = mass_properties(mesh);
      if (is_physical(own)) return own;
    } catch (const InputError&) {  // It encloses no volume, as a doubled sheet does; its thickened hulls do.
    }
  }
  return mass_properties(hulls);
}

void write_urdf(const std::filesystem::path& path, const RobotBody& body) {
  check(path, body);
  write_meshes_beside(path, body);
  const std::string name = escaped(body.name), folder = escaped(folder_name(path));
  const Eigen::Matrix3d inertia = body.density * body.mass.inertia;
  const Point& centre = body.mass.centre;
  std::string xml;
  const auto out = std::back_inserter(xml);
  fmt::format_to(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot name=\"{}\">\n  <link name=\"{}\">\n", name,
                 name);
  fmt::format_to(out,
                 "    <inertial>\n"
                 "      <origin xyz=\"{} {} {}\" rpy=\"0 0 0\"/>\n"
                 "      <mass value=\"{}\"/>\n"
                 "      <inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/>\n"
                 "    </inertial>\n",
                 centre[0], centre[1], centre[2], body.density * body.mass.volume, inertia(0, 0), inertia(0, 1),
                 inertia(0, 2), inertia(1, 1), inertia(1, 2), inertia(2, 2));
  const auto geometry = [&](const char* element, const std::string& mesh) {
    fmt::format_to(out,
                   "    <{0} name=\"{1}\">\n"
                   "      <origin xyz=\"0 0 0\" rpy=\"0 0 0\"/>\n"
                   "      <geometry>\n        <mesh filename=\"{2}/{1}.obj\"/>\n      </geometry>\n"
                   "    </{0}>\n",
                   element, mesh, folder);
  };
  if (body.visual) geometry("visual", "visual");
  for (std::size_t i = 0; i < body.hulls.size(); ++i) {
    if (!body.visual) geometry("visual", hull_name(i));
    geometry("collision", hull_name(i));
  }
  xml += "  </link>\n</robot>\n";
  write_file(path, xml);
}

void write_mjcf(const std::filesystem::path& path, const RobotBody& body) {
  check(path, body);
  write_meshes_beside(path, body);
  const std::string name = escaped(body.name);
  const Eigen::Matrix3d inertia = body.density * body.mass.inertia;
  const Point& centre = body.mass.centre;
  std::string xml;
  const auto out = std::back_inserter(xml);
  fmt::format_to(out, "<mujoco model=\"{}\">\n  <compiler meshdir=\"{}\"/>\n  <asset>\n", name,
                 escaped(folder_name(path)));
  for (std::size_t i = 0; i < body.hulls.size(); ++i)
    fmt::format_to(out, "    <mesh name=\"{0}\" file=\"{0}.obj\"/>\n", hull_name(i));
  if (body.visual) xml += "    <mesh name=\"visual\" file=\"visual.obj\"/>\n";
  fmt::format_to(out,
                 "  </asset>\n  <worldbody>\n    <body name=\"{}\">\n      <freejoint/>\n"
                 "      <inertial pos=\"{} {} {}\" mass=\"{}\" fullinertia=\"{} {} {} {} {} {}\"/>\n",
                 name, centre[0], centre[1], centre[2], body.density * body.mass.volume, inertia(0, 0), inertia(1, 1),
                 inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2));
  // Group 2 is drawn by default, group 3 (collision geometry) is not.
  const int group = body.visual ? 3 : 2;
  if (body.visual) xml += "      <geom type=\"mesh\" mesh=\"visual\" contype=\"0\" conaffinity=\"0\" group=\"2\"/>\n";
  for (std::size_t i = 0; i < body.hulls.size(); ++i)
    fmt::format_to(out, "      <geom name=\"{0}\" type=\"mesh\" mesh=\"{0}\" group=\"{1}\"/>\n", hull_name(i), group);
  xml += "    </body>\n  </worldbody>\n</mujoco>\n";
  write_file(path, xml);
}

}  // namespace partwise
