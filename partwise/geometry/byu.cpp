// MOVIE.BYU geometry as text (Christiansen and Stephenson, Brigham Young University): numbers of parts, vertices,
// polygons and edges; first and last polygon of each part; the vertices; the polygons, each a run of vertex numbers
// from 1 whose last is negative.
#include <fmt/format.h>

#include "partwise/geometry/mesh_builder.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

constexpr const char* kCutShort = "the file was cut short or the counts are wrong: export it again";

std::size_t to_count(TextScanner& scanner, std::string_view what) {
  const std::int64_t count = scanner.integer(what);
  if (count < 0) scanner.fail(fmt::format("{} is negative ({})", what, count), "correct the counts");
  return static_cast<std::size_t>(count);
}

// What is announced must fit into what is left, `least` bytes each, before anything is allocated.
void expect_room(const TextScanner& scanner, std::size_t count, std::size_t least, std::string_view what) {
  if (count > (scanner.remaining() + 1) / least) {
    scanner.fail(fmt::format("{} {} are announced, but the file is too short for them", count, what), kCutShort);
  }
}

void read_polygon(TextScanner& scanner, std::size_t polygon, MeshBuilder& builder) {
  for (bool last = false; !last;) {
    const std::int64_t number = scanner.integer("a vertex of a polygon");
    last = number < 0;
    // Compared before the sign is turned, which the smallest number has no room for.
    if (number == 0 || number > builder.vertex_count() || number < -builder.vertex_count()) {
      scanner.fail(
          fmt::format("polygon {} names vertex {}, the file has {} (from 1)", polygon, number, builder.vertex_count()),
          "fix or drop the polygon");
    }
    builder.add_corner((last ? -number : number) - 1);
  }
  if (builder.corners_of_open_face() < 3) {
    scanner.fail(
        fmt::format("polygon {} has {} corners, at least three are needed", polygon, builder.corners_of_open_face()),
        "remove the polygon");
  }
  builder.end_face();
}

}  // namespace

Mesh read_byu(const std::string& file, std::string_view bytes) {
  TextScanner scanner(file, bytes);
  const std::size_t parts = to_count(scanner, "the number of parts");
  const std::size_t vertices = to_count(scanner, "the number of vertices");
  const std::size_t polygons = to_count(scanner, "the number of polygons");
  to_count(scanner, "the number of edges");  // wrong in many files, and of no use

  expect_room(scanner, parts, 4, "parts");
  for (std::size_t i = 0; i < parts; ++i) {
    to_count(scanner, "the first polygon of a part");
    to_count(scanner, "the last polygon of a part");
  }
  expect_room(scanner, vertices, 6, "vertices");
  expect_room(scanner, polygons, 3, "polygons");
  MeshBuilder builder(file);
  builder.reserve(vertices, polygons);
  for (std::size_t i = 0; i < vertices; ++i) {
    const double x = scanner.coordinate("x of a vertex");
    const double y = scanner.coordinate("y of a vertex");
    const double z = scanner.coordinate("z of a vertex");
    builder.add_vertex(x, y, z);
  }
  for (std::size_t i = 0; i < polygons; ++i) read_polygon(scanner, i, builder);
  if (!scanner.at_end()) {
    scanner.token();
    scanner.fail(fmt::format("goes on after its {} polygons", polygons), "correct the counts, or remove the rest");
  }
  return builder.build();
}

}  // namespace partwise
