// OFF, as Geomview's manual describes it: [ST][C][N]OFF, counts, vertices, faces with optional colours.
#include <fmt/format.h>

#include <iterator>
#include <ostream>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_builder.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

constexpr const char* kCutShort = "the file was cut short or the counts are wrong: export it again";

bool is_integer(std::string_view token) {
  return !token.empty() && token.find_first_not_of("0123456789") == std::string_view::npos;
}

// Passes the keyword. What is returned is the count of vertices where the file has it glued to the keyword
// ("OFF490 518 0", as ModelNet has it) or no keyword, which Geomview allows; else it is empty.
std::string_view pass_keyword(TextScanner& scanner) {
  const std::string_view first = scanner.token();
  if (is_integer(first)) return first;
  const std::size_t off = first.find("OFF");
  if (off == std::string_view::npos) {
    scanner.fail(fmt::format("begins with {} instead of OFF", shown(first)),
                 "give an OFF file, or use the ending of its true format");
  }
  const std::string_view prefix = first.substr(0, off), glued = first.substr(off + 3);
  if (prefix.find_first_not_of("STCN") != std::string_view::npos) {
    scanner.fail(fmt::format("{} has points of other than three dimensions", shown(first)),
                 "export it with three coordinates a vertex");
  }
  if (glued.empty() || is_integer(glued)) return glued;
  scanner.fail(fmt::format("begins with {} instead of OFF", shown(first)),
               "give an OFF file, or use the ending of its true format");
}

std::size_t to_count(const TextScanner& scanner, std::string_view token, std::string_view what) {
  if (token == "BINARY") scanner.fail("is a binary OFF file", "export it as text");
  const std::int64_t count = scanner.to_integer(token, what);
  if (count < 0) scanner.fail(fmt::format("{} is negative ({})", what, count), "correct the counts");
  return static_cast<std::size_t>(count);
}

void read_face(TextScanner& scanner, std::size_t face, MeshBuilder& builder) {
  const std::int64_t corners = scanner.integer("the number of corners of a face");
  if (corners < 3) {
    scanner.fail(fmt::format("face {} has {} corners, at least three are needed", face, corners), "remove the face");
  }
  for (std::int64_t k = 0; k < corners; ++k) {
    const std::int64_t vertex = scanner.integer("a vertex of a face");
    if (vertex < 0 || vertex >= builder.vertex_count()) {
      scanner.fail(
          fmt::format("face {} names vertex {}, the file has {} (from 0)", face, vertex, builder.vertex_count()),
          "fix or drop the face");
    }
    builder.add_corner(vertex);
  }
  builder.end_face();
  scanner.skip_line();  // colours
}

}  // namespace

Mesh read_off(const std::string& file, std::string_view bytes) {
  TextScanner scanner(file, bytes, '#');
  std::string_view token = pass_keyword(scanner);
  if (token.empty()) token = scanner.token();
  const std::size_t vertices = to_count(scanner, token, "the number of vertices");
  const std::size_t faces = to_count(scanner, scanner.token(), "the number of faces");
  scanner.skip_line();  // The number of edges is wrong or missing in many files, and of no use.

  // The shortest vertex is "0 0 0" and a line end; a face, if wrong, may be as short as "2 0 1".
  const std::size_t room = (scanner.remaining() + 1) / 6;  // The last line end may be missing.
  if (vertices > room) {
    scanner.fail(fmt::format("{} vertices are announced, but the file is too short for them", vertices), kCutShort);
  }
  if (faces > room - vertices) {
    scanner.fail(fmt::format("{} faces are announced, but the file is too short for them", faces), kCutShort);
  }
  MeshBuilder builder(file);
  builder.reserve(vertices, faces);
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = scanner.coordinate("x of a vertex");
    const double y = scanner.coordinate("y of a vertex");
    const double z = scanner.coordinate("z of a vertex");
    builder.add_vertex(x, y, z);
    scanner.skip_line();  // normals, colours, texture coordinates
  }
  for (std::size_t face = 0; face < faces; ++face) read_face(scanner, face, builder);
  return builder.build();
}

void write_off(std::ostream& out, std::span<const NamedMeshView> meshes) {
  Eigen::Index vertices = 0, faces = 0;
  for (const NamedMeshView& each : meshes) {
    vertices += each.mesh->vertices.rows();
    faces += each.mesh->faces.rows();
  }
  out << fmt::format("OFF\n{} {} 0\n", vertices, faces);
  std::string text;
  for (const NamedMeshView& each : meshes) {
    text.clear();
    // Without a precision, fmt writes the shortest decimal that reads back as the same bits.
    for (const auto& v : each.mesh->vertices.rowwise())
      fmt::format_to(std::back_inserter(text), "{} {} {}\n", v[0], v[1], v[2]);
    out << text;
  }
  Eigen::Index first = 0;
  for (const NamedMeshView& each : meshes) {
    text.clear();
    for (const auto& f : each.mesh->faces.rowwise())
      fmt::format_to(std::back_inserter(text), "3 {} {} {}\n", first + f[0], first + f[1], first + f[2]);
    out << text;
    first += each.mesh->vertices.rows();
  }
}

}  // namespace partwise
