// A shape to be rendered, and which of its faces wear the same material: a mesh file or a model of a catalogue, and
// parts by a rule that needs no one's help.
//
// Vertices at equal places are joined first, so that what looks connected is; faces keep the order of the file. Parts:
//   whole       one
//   components  what is connected
//   corise      nearly convex pieces (parts/solid/decompose.h), of a tolerance in shares of the bounding sphere's radius
//   cvf         what people would cut, by continuous visibility (parts/surface/segmentation.h)
//   materials   what the faces wear in the file, an OBJ
//   labels      those of a .seg file, a line a face
// Those that are alike, and small ones with what they lie at, are then one (part_groups.h): at most `groups` are left.
//
// Deterministic, the same for any number of threads. Errors: InputError, one line that names the file, for one that
// cannot be read or has no face of positive area, for materials of what is no OBJ file or has none, for labels that do
// not fit the mesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct ShapeFile {
  std::filesystem::path file;  // a mesh, or an archive (.sh3f)
  std::string model{};         // of the archive
  std::filesystem::path labels{};
};

enum class PartRule { whole, components, corise, cvf, materials, labels };

struct PartSettings {
  PartRule rule = PartRule::components;
  int groups = 4;
  double tolerance = 0.1;  // of corise
};

bool is_archive(const std::filesystem::path& file);

Mesh read_shape(const ShapeFile& shape);

// The group of each face of that mesh, 0 .. in the order of their first faces.
std::vector<int> worn_parts(const ShapeFile& shape, const Mesh& mesh, const PartSettings& settings);

}  // namespace partwise
