#include "partwise/geometry/mesh_io.h"

#include <limits>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

enum class Format { off, obj, ply, stl, byu, gltf, glb };

std::optional<Format> known_format(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  for (const auto& [name, format] : {std::pair{".off", Format::off},
                                     {".obj", Format::obj},
                                     {".ply", Format::ply},
                                     {".stl", Format::stl},
                                     {".g", Format::byu},
                                     {".gltf", Format::gltf},
                                     {".glb", Format::glb}}) {
    if (equals_ignoring_case(ending, name)) return format;
  }
  return std::nullopt;
}

Format format_of(const std::filesystem::path& path) {
  if (const std::optional<Format> known = known_format(path)) return *known;
  const std::string ending = path.extension().string();
  throw InputError(path.string(),
                   ending.empty() ? "has no ending that names a mesh format"
                                  : fmt::format("{} is not the ending of a mesh format", shown(ending)),
                   "use .off, .obj, .ply, .stl, .g, .gltf or .glb");
}

// What a text in UTF-16 looks like to a reader of bytes is of no help to anyone.
void refuse_utf16(const std::string& file, std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
    throw InputError(file, "is text in UTF-16", "save it as plain text (ASCII or UTF-8)");
  }
}

Mesh read(const std::string& file, std::string_view bytes, const std::filesystem::path& folder) {
  const Format format = format_of(file);
  if (bytes.empty()) throw InputError(file, "is empty", "export the mesh again");
  if (format != Format::glb) refuse_utf16(file, bytes);
  switch (format) {
    case Format::off:
      return read_off(file, bytes);
    case Format::obj:
      return read_obj(file, bytes);
    case Format::ply:
      return read_ply(file, bytes);
    case Format::stl:
      return read_stl(file, bytes);
    case Format::byu:
      return read_byu(file, bytes);
    case Format::gltf:
      return read_gltf(file, bytes, folder);
    case Format::glb:
      return read_glb(file, bytes, folder);
  }
  throw CheckFailed("no reader for this format");
}

void check_indices(const Mesh& mesh) {
  if (mesh.faces.size() == 0) return;
  PARTWISE_CHECK(mesh.faces.minCoeff(), >=, 0);
  PARTWISE_CHECK(mesh.faces.maxCoeff(), <, mesh.vertices.rows());
}

void check_writable(const std::string& file, std::span<const NamedMeshView> meshes, bool single_precision) {
  for (const NamedMeshView& each : meshes) {
    check_indices(*each.mesh);
    if (!each.mesh->vertices.allFinite()) {
      throw InputError(file, "the mesh holds coordinates that are not finite", "correct or remove them");
    }
    if (single_precision && each.mesh->vertices.size() > 0 &&
        each.mesh->vertices.cwiseAbs().maxCoeff() > std::numeric_limits<float>::max()) {
      throw InputError(file, "coordinates are too large for the single precision of this format",
                       "use .off, .obj or .ply");
    }
  }
}

void write(const std::filesystem::path& path, std::span<const NamedMeshView> meshes) {
  const Format format = format_of(path);
  if (format == Format::gltf) {
    throw InputError(path.string(), "glTF is written as one binary file only", "use the ending .glb");
  }
  if (format == Format::byu) {
    throw InputError(path.string(), "BYU is read only", "use .off, .obj, .ply, .stl or .glb");
  }
  check_writable(path.string(), meshes, format == Format::stl || format == Format::glb);
  AtomicFile file(path);
  switch (format) {
    case Format::off:
      write_off(file.stream(), meshes);
      break;
    case Format::obj:
      write_obj(file.stream(), meshes);
      break;
    case Format::ply:
      write_ply(file.stream(), meshes);
      break;
    case Format::stl:
      write_stl(file.stream(), meshes);
      break;
    case Format::byu:
    case Format::gltf:
    case Format::glb:
      write_glb(file.stream(), meshes);
      break;
  }
  file.commit();
}

std::vector<NamedMeshView> views_of(std::span<const NamedMesh> meshes) {
  std::vector<NamedMeshView> views;
  for (const NamedMesh& each : meshes) views.push_back({each.name, &each.mesh, each.colour});
  return views;
}

// Counts that no memory holds are the file's fault, not ours.
template <typename Read>
Mesh within_memory(const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  throw InputError(file, "does not fit into memory", "reduce the mesh or use a machine with more memory");
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) { return known_format(path).has_value(); }

Mesh read_mesh(const std::filesystem::path& path) {
  format_of(path);  // before anything is read
  return within_memory(path.string(), [&] { return read(path.string(), read_bytes(path), path.parent_path()); });
}

Mesh read_mesh(const std::string& name, std::string_view bytes) {
  // A device has no files beside it: buffers must be inside.
  return within_memory(name, [&] { return read(name, bytes, "/dev/null"); });
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh) {
  const NamedMeshView only{.name = {}, .mesh = &mesh};
  write(path, {&only, 1});
}

void write_meshes(const std::filesystem::path& path, std::span<const NamedMesh> meshes) {
  write(path, views_of(meshes));
}

std::string encode_glb(std::span<const NamedMesh> meshes) {
  const std::vector<NamedMeshView> views = views_of(meshes);
  check_writable("GLB", views, true);
  std::ostringstream out;
  write_glb(out, views);
  return std::move(out).str();
}

}  // namespace partwise
