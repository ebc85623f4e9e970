// Wavefront OBJ: the polygonal part of it (v and f). Objects, groups, materials, normals, texture coordinates, lines,
// points and free-form surfaces are passed over.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <ostream>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_builder.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

// A face may name a vertex that follows it. The farthest such is remembered until the number of vertices is known.
struct ForwardReference {
  std::size_t position;
  std::int64_t vertex;
};

// The vertex, from 0, of a corner "v", "v/vt", "v//vn" or "v/vt/vn".
std::int64_t corner_vertex(const TextScanner& scanner, std::string_view corner, std::int64_t vertex_count) {
  const std::int64_t index = scanner.to_integer(corner.substr(0, corner.find('/')), "a vertex of a face");
  if (index == 0) scanner.fail("a face names vertex 0, but OBJ counts from 1", "export the file again");
  if (index > 0) return index - 1;
  if (index < -vertex_count) {
    scanner.fail(fmt::format("a face names vertex {}, only {} come before it", index, vertex_count),
                 "fix or drop the face");
  }
  return vertex_count + index;
}

void read_face(TextScanner& scanner, MeshBuilder& builder, std::optional<ForwardReference>& farthest) {
  for (std::string_view corner = scanner.token_in_line(); !corner.empty(); corner = scanner.token_in_line()) {
    const std::int64_t vertex = corner_vertex(scanner, corner, builder.vertex_count());
    if (vertex >= builder.vertex_count() && (!farthest || vertex > farthest->vertex)) {
      farthest = ForwardReference{scanner.position(), vertex};
    }
    builder.add_corner(vertex);
  }
  if (builder.corners_of_open_face() == 0) {
    scanner.fail(fmt::format("face {} has no corners", builder.face_count()), "remove the face");
  }
  builder.end_any_face();
}

// An object's name stands on one line and has no blanks.
std::string object_name(std::string_view name) {
  std::string safe(name);
  for (char& c : safe)
    if (static_cast<unsigned char>(c) <= ' ' || c == '#' || c == '\\' || c == 0x7F) c = '_';
  return safe;
}

}  // namespace

Mesh read_obj(const std::string& file, std::string_view bytes) {
  TextScanner scanner(file, bytes, '#');
  MeshBuilder builder(file);
  std::optional<ForwardReference> farthest;
  for (std::string_view keyword = scanner.token(); !keyword.empty(); keyword = scanner.token()) {
    if (keyword == "v") {
      double point[3];
      for (double& value : point) {
        if (scanner.at_line_end()) scanner.fail("a vertex has fewer than three coordinates", "complete the line");
        value = scanner.coordinate("a coordinate of a vertex");
      }
      builder.add_vertex(point[0], point[1], point[2]);
      scanner.skip_line();                           // a weight or a colour
    } else if (keyword == "f" || keyword == "fo") {  // fo: the same in files of version 2.11
      read_face(scanner, builder, farthest);
    } else {
      scanner.skip_line();
    }
  }
  if (farthest && farthest->vertex >= builder.vertex_count()) {
    throw InputError(
        scanner.place(farthest->position),
        fmt::format("a face names vertex {}, the file has {} (from 1)", farthest->vertex + 1, builder.vertex_count()),
        "fix or drop the face");
  }
  return builder.build();
}

FaceMaterials read_obj_materials(const std::string& file, std::string_view bytes) {
  TextScanner scanner(file, bytes, '#');
  FaceMaterials materials;
  bool any = false;
  std::string worn;
  for (std::string_view keyword = scanner.token(); !keyword.empty(); keyword = scanner.token()) {
    if (keyword == "usemtl") {
      worn.clear();
      for (std::string_view word = scanner.token_in_line(); !word.empty(); word = scanner.token_in_line()) {
        if (!worn.empty()) worn += ' ';
        worn += word;
      }
      any = true;
    } else if (keyword == "f" || keyword == "fo") {
      std::size_t corners = 0;
      while (!scanner.token_in_line().empty()) ++corners;
      const auto found = std::ranges::find(materials.names, worn);
      const auto place = static_cast<int>(found - materials.names.begin());
      if (found == materials.names.end()) materials.names.push_back(worn);
      materials.of_face.insert(materials.of_face.end(), std::max<std::size_t>(corners, 2) - 2, place);
    }
    if (keyword != "f" && keyword != "fo") scanner.skip_line();
  }
  if (!any) throw InputError(file, "names no materials (usemtl)", "tell parts apart by something else");
  return materials;
}

void write_obj(std::ostream& out, std::span<const NamedMeshView> meshes) {
  Eigen::Index first = 1;
  std::string text;
  for (const NamedMeshView& each : meshes) {
    text.clear();
    if (!each.name.empty()) fmt::format_to(std::back_inserter(text), "o {}\n", object_name(each.name));
    for (const auto& v : each.mesh->vertices.rowwise())
      fmt::format_to(std::back_inserter(text), "v {} {} {}\n", v[0], v[1], v[2]);
    for (const auto& f : each.mesh->faces.rowwise())
      fmt::format_to(std::back_inserter(text), "f {} {} {}\n", first + f[0], first + f[1], first + f[2]);
    out << text;
    first += each.mesh->vertices.rows();
  }
}

}  // namespace partwise
