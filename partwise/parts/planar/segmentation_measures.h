// How alike two decompositions of one shape are (Liu 2017, section 2.3.4.2): the Rand index over the cells of a grid,
// and the Cluster Coverage of a decomposition's cuts by those of others.
//
// Any decomposition given as polygons can be judged; nothing is asked of its cuts.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "partwise/geometry/polygon.h"

namespace partwise {

// Parts on a regular grid that tightly bounds a box: the index of the part that holds the most of a cell, or -1 where
// not more than half of the cell lies in parts. Areas of cells are counted by 4 x 4 points. Each polygon is a part, or
// belongs to the part that `owner` names.
struct LabelGrid {
  int size = 200;
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), cell = Eigen::Vector2d::Ones();
  std::vector<int> labels;  // size x size, row by row from the least y
};

LabelGrid label_grid(std::span<const Polygon> parts, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                     int size = 200, std::span<const int> owner = {});

// The share of pairs of cells, valid in both, that both put into one part or both into two. Errors: InputError where
// fewer than two cells are valid in both; CheckFailed for grids of different size.
double rand_index(const LabelGrid& a, const LabelGrid& b);

// A cut as the chord between the ends of what two parts share; the end with the smaller x (then y) first.
using CutLine = Eigen::Vector4d;
std::vector<CutLine> cut_lines(std::span<const Polygon> parts);

// The cuts of several decompositions by k-means, k the mean number of cuts of one (rounded, at least 1); k-means++
// seeded, best of eight starts.
struct CutCluster {
  CutLine centre, representative;  // the member nearest to the centre
  double radius = 0;               // largest distance of a member to the centre
  int members = 0;
};
std::vector<CutCluster> cluster_cuts(std::span<const std::vector<CutLine>> decompositions, std::uint64_t seed);

// CC: the share of the clustered cuts whose cluster has a cut of this decomposition. A cut belongs to the cluster with
// the nearest centre when it is no farther from it than the cluster's radius or `least_radius`, whichever is larger.
double cluster_coverage(std::span<const CutLine> cuts, std::span<const CutCluster> clusters, double least_radius);

// The cells of a grid, relabelled by the components into which the representative cuts divide them. Cuts that do not
// reach from boundary to boundary divide nothing.
LabelGrid representative_grid(const LabelGrid& cells, std::span<const CutCluster> clusters);

}  // namespace partwise
