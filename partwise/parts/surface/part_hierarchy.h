// The parts of a mesh as a tree, each node with histograms of what its surface is like (section 2.2.4.4 of Liu 2017,
// after Shapira, Shalom, Shamir, Cohen-Or, Zhang 2010, *Contextual part analogies in 3D objects*).
//
// The parts of a segmentation are the leaves, the whole mesh is the root. The text leaves open what is between them;
// here it is what hangs together once the middle is taken away. Of the whole, the most central part (that with the face
// of least centricity) is one child; each connected piece of the other parts, a limb, is another, and a limb of several
// parts is divided in the same way. So a hand comes below its arm and the arm below the whole, however many parts the
// arm was cut into, and limbs that play the same role, such as the four legs of a table, have paths of the same kind.
// Pieces of a mesh that do not touch meet in the root.
//
// Faces are described by three levels in octaves, which depend neither on the scale of the mesh nor much on its pose:
// log2 of continuous visibility over the mesh's area, of thickness over the square root of that area, and of
// centricity. A node has two tables, side by side: how much of the mesh's area has which visibility at which
// centricity, and which thickness at which centricity. Half of a face's share of the area goes to each table, there to
// the four bins about its levels by nearness, so that small changes change a table little. The sum of both is the
// node's share of the mesh's area.
//
// Errors: InputError for labels or measures that do not fit the mesh, or a mesh without area.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

// One value a face each.
struct SurfaceMeasures {
  Eigen::VectorXd visibility;  // continuous_visibility.h, model units squared
  Eigen::VectorXd thickness;   // shape_diameter.h, model units
  Eigen::VectorXd centricity;  // surface_centricity.h
};

// Levels below or above count as the least or the greatest.
struct HierarchySettings {
  int bins = 12;                 // along each side of a table, at least 2
  double visibility_range = 10;  // octaves: shares of 2^-10 .. 1 of the area
  double thickness_range = 6;    // 2^-6 .. 1 of the square root of the area
  double centricity_range = 2;   // 1 .. 4
};

struct PartHierarchy {
  int parts = 0;               // the nodes 0 .. parts - 1 are the parts, numbered as they are labelled
  std::vector<int> parents;    // of each node, a larger number; -1 for the root, which is the last
  Eigen::MatrixXd histograms;  // nodes x (2 bins^2): both tables, a row of bins of centricity after the other

  int nodes() const { return static_cast<int>(parents.size()); }

  // The nodes from a part to the root, both included.
  std::vector<int> root_path(int part) const;
};

// labels: of each face, 0 .. parts - 1, each in use.
PartHierarchy part_hierarchy(const Mesh& mesh, std::span<const int> labels, const SurfaceMeasures& measures,
                             const HierarchySettings& settings = {});

}  // namespace partwise
