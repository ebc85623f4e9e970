// One reader and one writer a file format, behind mesh_io.h.
//
// Readers take the name of the file, for messages, and all its bytes. Writers write to a stream that is renamed into
// place afterwards; meshes are joined where the format knows only one.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>

#include "partwise/geometry/mesh.h"

namespace partwise {

// A mesh to be written; an empty name writes no object.
struct NamedMeshView {
  std::string_view name;
  const Mesh* mesh = nullptr;
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(0.8f);  // linear RGB
};

Mesh read_off(const std::string& file, std::string_view bytes);
Mesh read_obj(const std::string& file, std::string_view bytes);
Mesh read_ply(const std::string& file, std::string_view bytes);
Mesh read_stl(const std::string& file, std::string_view bytes);
Mesh read_byu(const std::string& file, std::string_view bytes);
// Buffers that are files of their own are looked for in `folder`.
Mesh read_gltf(const std::string& file, std::string_view bytes, const std::filesystem::path& folder);
Mesh read_glb(const std::string& file, std::string_view bytes, const std::filesystem::path& folder);

void write_off(std::ostream& out, std::span<const NamedMeshView> meshes);
void write_obj(std::ostream& out, std::span<const NamedMeshView> meshes);
void write_ply(std::ostream& out, std::span<const NamedMeshView> meshes);
void write_stl(std::ostream& out, std::span<const NamedMeshView> meshes);
void write_glb(std::ostream& out, std::span<const NamedMeshView> meshes);

}  // namespace partwise
