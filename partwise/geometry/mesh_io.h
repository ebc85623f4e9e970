// Triangle meshes from and to files: OFF, OBJ, PLY (ascii, binary little and big endian), STL (ascii and binary),
// glTF 2.0 (.gltf and .glb). The format is chosen by the ending, in any case of letters.
//
// Reading. Polygons are triangulated (fan for convex ones, ear clipping otherwise). Several objects, groups or glTF nodes
// (with their transforms) become one mesh in file order. STL's corners, which have no common indices, are joined where
// their coordinates are equal to the bit; so are glTF's, whose vertices are split at seams. Colours, normals, textures
// and materials are passed over. Vertices that no face uses stay, and so do degenerate and repeated faces: `read_mesh`
// keeps the face order and the vertex order of the file (OFF, OBJ, PLY), so that a line a face in a .seg file fits it.
//
// Errors: InputError with file (and line or byte where that says more), what is wrong and what to do, for a file that
// cannot be read, is cut short, has no faces, names vertices that do not exist, or holds NaN or infinite coordinates.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

Mesh read_mesh(const std::filesystem::path& path);

// Writes OFF, OBJ, PLY (binary), STL (binary) or GLB by the ending; positions of OFF and OBJ with 17 digits. Atomic.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

struct NamedMesh {
  std::string name;
  Mesh mesh;
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(0.8f);  // linear RGB in [0, 1]; used where the format has colour
};

// One object (OBJ `o`) or one node with its own mesh and material (GLB) a member. Vertices are not shared. Atomic.
void write_meshes(const std::filesystem::path& path, std::span<const NamedMesh> meshes);

// Princeton's .seg: one line a face, its label.
std::vector<int> read_labels(const std::filesystem::path& path);
void write_labels(const std::filesystem::path& path, std::span<const int> labels);

}  // namespace partwise
