// A labelled mesh as one coloured mesh a part, for files that a viewer shows.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise::cli {

// One member a part, "part_0" first, with vertices of its own. labels: one a face, 0 .. parts - 1.
std::vector<NamedMesh> part_meshes(const Mesh& mesh, std::span<const int> labels, int parts);

// One member a hull, named and coloured as the part that it encloses.
std::vector<NamedMesh> hull_meshes(std::span<const Mesh> hulls);

// Faces of like value as one member each, coloured from dark blue for the least value to yellow for the most. One
// value a face.
std::vector<NamedMesh> value_meshes(const Mesh& mesh, const Eigen::VectorXd& values);

}  // namespace partwise::cli
