// Meshes and points in colours that say something: to which part a face belongs, or how large a value is.
//
// Values are coloured by value_colour (palette.h) from the least, dark blue, to the most, yellow; where all are the
// same, all have the colour of the least. Errors: CheckFailed for lists of unequal length.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/appearance/preview.h"
#include "partwise/geometry/mesh.h"

namespace partwise {

// One label a face, 0 or more.
PreviewMesh coloured_by_part(const Mesh& mesh, std::span<const int> labels);

// One value a face.
PreviewMesh coloured_by_value(const Mesh& mesh, const Eigen::VectorXd& values);

// One value a point; spheres of the same radius. Values that no eye tells apart are one member.
std::vector<PreviewPoints> coloured_by_value(const Vertices& points, std::span<const double> values, double radius);

}  // namespace partwise
