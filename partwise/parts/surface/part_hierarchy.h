// The parts of a mesh as a tree, each node with a histogram of continuous visibility (section 2.2.4.4 of Liu 2017,
// after Shapira, Shalom, Shamir, Cohen-Or, Zhang 2010, *Contextual part analogies in 3D objects*).
//
// The parts of a segmentation are the leaves, the whole mesh is the root. The text leaves open what is between them;
// here it is this. The level of a face is log2 of its value over the mesh's area, so that levels do not depend on the
// scale of the mesh and differ by 1 where one face sees twice as much as another; the level of a part is the mean over
// its area. Neighbouring parts (that share an edge) whose levels differ by at most the first of `steps` form a group,
// then groups whose parts are linked by at most the second, and so on; what is left at the end is gathered by the root.
// Groups of several members become nodes. Unlike merging pair by pair this treats parts that play the same role alike:
// the four legs of a table, or six of an ant, all come to their body in one step.
//
// The histogram of a node says how much of the mesh's area has which level. A face counts for the two bins next to its
// level, by nearness, so that small changes of visibility change a histogram little. Its sum is the node's share of the
// mesh's area.
//
// Errors: InputError for labels or values that do not fit the mesh, or a mesh without area.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct HierarchySettings {
  int bins = 32;                    // of a histogram, at least 2
  double octaves = 10;              // bins range over shares of 2^-octaves .. 1 of the area; less counts as the least
  std::vector<double> steps = {1};  // octaves, ascending
};

struct PartHierarchy {
  int parts = 0;               // the nodes 0 .. parts - 1 are the parts, numbered as they are labelled
  std::vector<int> parents;    // of each node, a larger number; -1 for the root, which is the last
  Eigen::MatrixXd histograms;  // nodes x bins, shares of the mesh's area

  int nodes() const { return static_cast<int>(parents.size()); }

  // The nodes from a part to the root, both included.
  std::vector<int> root_path(int part) const;
};

// labels: of each face, 0 .. parts - 1, each in use; values: of each face, continuous visibility in model units
// squared.
PartHierarchy part_hierarchy(const Mesh& mesh, std::span<const int> labels, const Eigen::VectorXd& values,
                             const HierarchySettings& settings = {});

}  // namespace partwise
