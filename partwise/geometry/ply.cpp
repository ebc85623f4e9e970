// PLY (Turk 1994), ascii and binary of both byte orders. Of the element "vertex" x, y and z are read, of "face" the
// list "vertex_indices" or "vertex_index"; all else is passed over.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <ostream>

#include "partwise/base/error.h"
#include "partwise/geometry/bytes.h"
#include "partwise/geometry/mesh_builder.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/ply_header.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

constexpr const char* kCutShort = "the file was cut short or its header is wrong: export it again";

// Numbers one after the other, from text.
class TextSource {
 public:
  TextSource(const std::string& file, std::string_view bytes, std::size_t start) : scanner_(file, bytes) {
    scanner_.seek(start);
  }
  std::size_t remaining() const { return scanner_.remaining() + 1; }  // The last line end may be missing.
  double coordinate(PlyType) { return scanner_.coordinate("a coordinate of a vertex"); }
  std::int64_t integer(PlyType) { return scanner_.integer("a number of a list"); }
  void pass(PlyType) {
    if (scanner_.token().empty()) fail("the file ends inside an element", kCutShort);
  }
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    scanner_.fail(problem, remedy);
  }

 private:
  TextScanner scanner_;
};

// Numbers one after the other, from bytes.
class BinarySource {
 public:
  BinarySource(const std::string& file, std::string_view bytes, std::size_t start, std::endian order)
      : file_(file), bytes_(bytes), next_(start), order_(order) {}

  std::size_t remaining() const { return bytes_.size() - next_; }

  double coordinate(PlyType type) {
    const double value = number(type);
    if (!std::isfinite(value)) fail("a coordinate of a vertex is not finite", "correct or remove what holds it");
    return value;
  }

  std::int64_t integer(PlyType type) {
    const double value = number(type);  // Exact: no type holds integers of more than 32 bits.
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<std::uint32_t>::max()) {
      fail(fmt::format("a list holds {}, which is no integer", value), "export it with integer indices");
    }
    return static_cast<std::int64_t>(value);
  }

  void pass(PlyType type) { take(size_of(type)); }

  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw InputError(fmt::format("{}: byte {}", file_, next_), problem, remedy);
  }

 private:
  const char* take(std::size_t size) {
    if (size > remaining()) fail("the file ends inside an element", kCutShort);
    const char* at = bytes_.data() + next_;
    next_ += size;
    return at;
  }

  double number(PlyType type) {
    const char* at = take(size_of(type));
    switch (type) {
      case PlyType::int8:
        return load<std::int8_t>(at, order_);
      case PlyType::uint8:
        return load<std::uint8_t>(at, order_);
      case PlyType::int16:
        return load<std::int16_t>(at, order_);
      case PlyType::uint16:
        return load<std::uint16_t>(at, order_);
      case PlyType::int32:
        return load<std::int32_t>(at, order_);
      case PlyType::uint32:
        return load<std::uint32_t>(at, order_);
      case PlyType::float32:
        return load<float>(at, order_);
      case PlyType::float64:
        break;
    }
    return load<double>(at, order_);
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t next_;
  std::endian order_;
};

template <typename Source>
std::int64_t list_length(Source& source, const PlyProperty& property) {
  const std::int64_t length = source.integer(property.count_type);
  if (length < 0 || static_cast<std::size_t>(length) > source.remaining()) {
    source.fail(fmt::format("a list of {} numbers does not fit into the file", length), kCutShort);
  }
  return length;
}

template <typename Source>
void pass_property(Source& source, const PlyProperty& property) {
  const std::int64_t numbers = property.is_list ? list_length(source, property) : 1;
  for (std::int64_t i = 0; i < numbers; ++i) source.pass(property.type);
}

template <typename Source>
void read_vertices(Source& source, const PlyElement& element, MeshBuilder& builder) {
  const std::array<int, 3> axes{element.find("x"), element.find("y"), element.find("z")};
  for (std::size_t i = 0; i < element.count; ++i) {
    std::array<double, 3> point{};
    for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
      const std::size_t axis = p == axes[0] ? 0 : p == axes[1] ? 1 : p == axes[2] ? 2 : 3;
      if (axis < 3) {
        point[axis] = source.coordinate(element.properties[p].type);
      } else {
        pass_property(source, element.properties[p]);
      }
    }
    builder.add_vertex(point[0], point[1], point[2]);
  }
}

template <typename Source>
void read_faces(Source& source, const PlyElement& element, int list, std::size_t vertices, MeshBuilder& builder) {
  for (std::size_t face = 0; face < element.count; ++face) {
    for (int p = 0; p < static_cast<int>(element.properties.size()); ++p) {
      const PlyProperty& property = element.properties[p];
      if (p != list) {
        pass_property(source, property);
        continue;
      }
      const std::int64_t corners = list_length(source, property);
      if (corners < 3) {
        source.fail(fmt::format("face {} has {} corners, at least three are needed", face, corners), "remove the face");
      }
      for (std::int64_t k = 0; k < corners; ++k) {
        const std::int64_t vertex = source.integer(property.type);
        if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices) {
          source.fail(fmt::format("face {} names vertex {}, the file has {} (from 0)", face, vertex, vertices),
                      "fix or drop the face");
        }
        builder.add_corner(vertex);
      }
      builder.end_face();
    }
  }
}

// The element of that name; null when the file has none.
const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements)
    if (element.name == name) return &element;
  return nullptr;
}

template <typename Source>
Mesh read_elements(const std::string& file, const PlyHeader& header, Source source) {
  const PlyElement* vertex = find_element(header, "vertex");
  if (!vertex) throw InputError(file, "has no element 'vertex'", "export a mesh with vertices and faces");
  for (const char* axis : {"x", "y", "z"}) {
    const int place = vertex->find(axis);
    if (place < 0 || vertex->properties[place].is_list) {
      throw InputError(file, fmt::format("its vertices have no number '{}'", axis), "export it with x, y and z");
    }
  }
  const PlyElement* face = find_element(header, "face");
  int list = -1;
  if (face && face->count > 0) {
    list = std::max(face->find("vertex_indices"), face->find("vertex_index"));
    if (list < 0 || !face->properties[list].is_list) {
      throw InputError(file, "its faces have no list 'vertex_indices'", "export it with a list of vertices a face");
    }
  } else if (find_element(header, "tristrips")) {
    throw InputError(file, "holds triangle strips instead of faces", "export it with faces");
  }

  MeshBuilder builder(file);
  for (const PlyElement& element : header.elements) {
    const std::size_t smallest = element.smallest_size(header.format);
    if (smallest == 0) continue;  // without properties
    if (element.count > source.remaining() / smallest) {
      source.fail(fmt::format("{} elements '{}' are announced, but the file is too short for them", element.count,
                              element.name),
                  kCutShort);
    }
    if (&element == vertex) {
      builder.reserve(element.count, 0);
      read_vertices(source, element, builder);
    } else if (&element == face) {
      builder.reserve(0, element.count);
      read_faces(source, element, list, vertex->count, builder);
    } else {
      for (std::size_t i = 0; i < element.count; ++i)
        for (const PlyProperty& property : element.properties) pass_property(source, property);
    }
  }
  return builder.build();
}

}  // namespace

Mesh read_ply(const std::string& file, std::string_view bytes) {
  const PlyHeader header = read_ply_header(file, bytes);
  if (header.format == PlyFormat::ascii) return read_elements(file, header, TextSource(file, bytes, header.size));
  const std::endian order = header.format == PlyFormat::binary_big_endian ? std::endian::big : std::endian::little;
  return read_elements(file, header, BinarySource(file, bytes, header.size, order));
}

void write_ply(std::ostream& out, std::span<const NamedMeshView> meshes) {
  Eigen::Index vertices = 0, faces = 0;
  for (const NamedMeshView& each : meshes) {
    vertices += each.mesh->vertices.rows();
    faces += each.mesh->faces.rows();
  }
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      vertices, faces);
  std::string bytes;
  for (const NamedMeshView& each : meshes) {
    bytes.clear();
    for (const double coordinate : each.mesh->vertices.reshaped<Eigen::RowMajor>()) store(bytes, coordinate);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  std::int32_t first = 0;
  for (const NamedMeshView& each : meshes) {
    bytes.clear();
    for (const auto& f : each.mesh->faces.rowwise()) {
      store(bytes, std::uint8_t{3});
      for (int k = 0; k < 3; ++k) store(bytes, static_cast<std::int32_t>(first + f[k]));
    }
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    first += static_cast<std::int32_t>(each.mesh->vertices.rows());
  }
}

}  // namespace partwise
