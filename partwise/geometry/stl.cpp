// STL, ascii and binary (3D Systems 1988). Normals and attributes are passed over, they follow from the corners.
#include <fmt/format.h>

#include <Eigen/Geometry>

#include <cmath>
#include <ostream>

#include "partwise/base/error.h"
#include "partwise/geometry/bytes.h"
#include "partwise/geometry/mesh_builder.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/text_scanner.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

constexpr std::size_t kHeader = 84;  // 80 bytes of any text, and the number of triangles
constexpr std::size_t kRecord = 50;  // normal, three corners, attribute
constexpr const char* kExportAgain = "export the file again";

// Binary files may begin with "solid" too, so their size decides; text has a second keyword soon after the first.
bool is_ascii(std::string_view bytes) {
  if (bytes.size() >= kHeader && bytes.size() == kHeader + kRecord * load<std::uint32_t>(&bytes[80])) return false;
  TextScanner scanner({}, bytes);
  if (!equals_ignoring_case(scanner.token(), "solid")) return false;
  scanner.skip_line();
  const std::string_view second = scanner.token();
  return second.empty() || equals_ignoring_case(second, "facet") || equals_ignoring_case(second, "endsolid") ||
         equals_ignoring_case(second, "color") || bytes.size() < kHeader;
}

void read_loop(TextScanner& scanner, MeshBuilder& builder) {
  for (;;) {
    const std::string_view keyword = scanner.token();
    if (equals_ignoring_case(keyword, "vertex")) {
      const double x = scanner.coordinate("x of a vertex");
      const double y = scanner.coordinate("y of a vertex");
      const double z = scanner.coordinate("z of a vertex");
      builder.add_corner(builder.vertex_count());
      builder.add_vertex(x, y, z);
    } else if (equals_ignoring_case(keyword, "endloop")) {
      break;
    } else if (keyword.empty()) {
      scanner.fail("the file ends inside a facet", "it was cut short: export it again");
    } else {
      scanner.fail(fmt::format("{} stands where vertex or endloop should be", shown(keyword)), kExportAgain);
    }
  }
  if (builder.corners_of_open_face() < 3) {
    scanner.fail(fmt::format("face {} has {} corners, at least three are needed", builder.face_count(),
                             builder.corners_of_open_face()),
                 "remove the facet");
  }
  builder.end_face();
}

Mesh read_ascii(const std::string& file, std::string_view bytes) {
  TextScanner scanner(file, bytes);
  MeshBuilder builder(file);
  bool in_solid = false;
  for (std::string_view keyword = scanner.token(); !keyword.empty(); keyword = scanner.token()) {
    if (equals_ignoring_case(keyword, "solid")) {
      in_solid = true;
      scanner.skip_line();  // its name
    } else if (equals_ignoring_case(keyword, "endsolid")) {
      in_solid = false;
      scanner.skip_line();
    } else if (equals_ignoring_case(keyword, "facet")) {
      for (int i = 0; i < 4; ++i) scanner.token();  // the normal
    } else if (equals_ignoring_case(keyword, "color")) {
      scanner.skip_line();
    } else if (equals_ignoring_case(keyword, "outer")) {
      scanner.token();  // loop
      read_loop(scanner, builder);
    } else if (!equals_ignoring_case(keyword, "endfacet")) {
      scanner.fail(fmt::format("{} is not a word of STL", shown(keyword)), kExportAgain);
    }
  }
  if (in_solid) {
    scanner.fail("the file ends without endsolid",
                 "it was probably cut short: export it again, or add the line if nothing is missing");
  }
  return builder.build();
}

Mesh read_binary(const std::string& file, std::string_view bytes) {
  if (bytes.size() < kHeader) {
    throw InputError(file,
                     fmt::format("is neither text that begins with solid nor as long as a binary STL's header "
                                 "({} of {} bytes)",
                                 bytes.size(), kHeader),
                     "give an STL file, or use the ending of its true format");
  }
  const std::size_t announced = load<std::uint32_t>(&bytes[80]);
  const std::size_t held = (bytes.size() - kHeader) / kRecord;
  if (announced != held) {  // Fewer bytes than a triangle's after the last do no harm.
    throw InputError(fmt::format("{}: byte 80", file),
                     fmt::format("the header announces {} triangles, the file holds {}", announced, held),
                     announced > held ? "the file was cut short or is no STL: export it again" : kExportAgain);
  }
  MeshBuilder builder(file);
  builder.reserve(3 * held, held);
  for (std::size_t face = 0; face < held; ++face) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = kHeader + kRecord * face + 12 * (corner + 1);
      const float x = load<float>(&bytes[at]), y = load<float>(&bytes[at + 4]), z = load<float>(&bytes[at + 8]);
      if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
        throw InputError(fmt::format("{}: byte {}", file, at),
                         fmt::format("face {} has a corner that is not finite", face), "correct or remove the face");
      }
      builder.add_corner(builder.vertex_count());
      builder.add_vertex(x, y, z);
    }
    builder.end_face();
  }
  return builder.build();
}

}  // namespace

Mesh read_stl(const std::string& file, std::string_view bytes) {
  return weld(is_ascii(bytes) ? read_ascii(file, bytes) : read_binary(file, bytes));
}

void write_stl(std::ostream& out, std::span<const NamedMeshView> meshes) {
  std::uint32_t faces = 0;
  for (const NamedMeshView& each : meshes) faces += static_cast<std::uint32_t>(each.mesh->faces.rows());
  std::string bytes = "binary STL";
  bytes.resize(80, ' ');
  store(bytes, faces);
  for (const NamedMeshView& each : meshes) {
    const Vertices& vertices = each.mesh->vertices;
    for (const auto& f : each.mesh->faces.rowwise()) {
      const Point a = vertices.row(f[0]), b = vertices.row(f[1]), c = vertices.row(f[2]);
      const Point normal = (b - a).cross(c - a).stableNormalized();  // zero for a face without area
      for (const Point& row : {normal, a, b, c})
        for (const double value : row) store(bytes, static_cast<float>(value));
      store(bytes, std::uint16_t{0});
    }
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.clear();
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));  // the header, when there are no meshes
}

}  // namespace partwise
