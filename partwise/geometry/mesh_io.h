// Triangle meshes from and to files: OFF, OBJ, PLY (ascii, binary little and big endian), STL (ascii and binary),
// MOVIE.BYU (.g, as text; read only), glTF 2.0 (.gltf and .glb). The format is chosen by the ending, in any case of
// letters.
//
// Reading. Polygons are triangulated (a fan for convex ones, ear clipping otherwise). Several objects, groups or glTF
// nodes (with their transforms; mirrors turn the faces back) become one mesh in file order. STL's corners, which have
// no common indices, are joined where their coordinates are equal (0 and -0 too), and so are, within each mesh of a
// glTF, its vertices, which are split at seams; those that no triangle uses are dropped there. Colours, normals,
// textures and materials are passed over. In OFF, OBJ, PLY and BYU vertices that no face uses stay, and degenerate and
// repeated faces stay everywhere: `read_mesh` keeps the face order and (OFF, OBJ, PLY, BYU) the vertex order of the
// file, so that a line a face in a .seg file fits it. A polygon of n corners is n - 2 faces in a row.
//
// What real files do is understood: comments, blank lines, line ends of any system, UTF-8 with a byte order mark; OFF
// with colours or normals, with a wrong or no number of edges, with counts glued to the keyword; OBJ with negative
// indices and lines joined by a backslash; PLY with further elements and properties; binary STL that begins with
// "solid".
//
// Errors: InputError, one line, with file (and line or byte where that says more), what is wrong and what to do, for a
// file that cannot be read, is cut short, has no faces, has a face of fewer than three corners, names vertices that do
// not exist, holds NaN or infinite coordinates, or does not fit into memory. Counts in a header are checked against the
// length of the file before anything is allocated. Not read, with a message: binary OFF, triangle strips in PLY, sparse
// accessors and compression in glTF.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

Mesh read_mesh(const std::filesystem::path& path);

// The same from memory, for files within files: `name` is named in messages and its ending chooses the format. A glTF
// must hold its buffers itself.
Mesh read_mesh(const std::string& name, std::string_view bytes);

// Whether the ending is that of a format that is read.
bool is_mesh_file(const std::filesystem::path& path);

// What the faces of an OBJ file wear: the names that its lines usemtl give, in the order of their first use, and of
// each face of the mesh that read_mesh makes of it the place of its own; "" before the first such line. Errors: as
// read_mesh, and for a file without such a line.
struct FaceMaterials {
  std::vector<std::string> names;
  std::vector<int> of_face;
};
FaceMaterials read_obj_materials(const std::string& name, std::string_view bytes);

// Writes OFF, OBJ, PLY (binary), STL (binary) or GLB by the ending. Atomic. OFF, OBJ and PLY hold the positions to the
// bit (text has the shortest digits that read back as the same double), STL and GLB in single precision.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

struct NamedMesh {
  std::string name;
  Mesh mesh;
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(0.8f);  // linear RGB in [0, 1]; used in GLB
};

// One object (OBJ `o`) or one node with its own mesh and material (GLB) a member; the other formats know one mesh only
// and get all as one. Vertices are not shared. Atomic.
void write_meshes(const std::filesystem::path& path, std::span<const NamedMesh> meshes);

// The bytes that it writes into a GLB, with the same errors about what is in the meshes.
std::string encode_glb(std::span<const NamedMesh> meshes);

// Princeton's .seg: one line a face, its label.
std::vector<int> read_labels(const std::filesystem::path& path);
void write_labels(const std::filesystem::path& path, std::span<const int> labels);

}  // namespace partwise
