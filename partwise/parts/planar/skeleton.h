// Skeletons from a decomposition (Liu 2017, figure 2.22): a graph that runs through the middles of the cuts and the
// centres of the parts, and out to the tip of parts that hang on one neighbour only.
#pragma once

#include <utility>
#include <vector>

#include "partwise/parts/planar/outline.h"

namespace partwise {

enum class SkeletonNodeKind { part, cut, tip };

struct SkeletonNode {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  SkeletonNodeKind kind = SkeletonNodeKind::part;
  int part = -1;  // of parts and tips
};

struct Skeleton {
  std::vector<SkeletonNode> nodes;         // the first ones are the parts, in order
  std::vector<std::pair<int, int>> edges;  // of nodes
};

// Cuts between the same two parts that meet end to end count as one. A part with exactly two cuts whose centre lies
// aside is passed through its centre all the same, so that the graph has one node a part.
Skeleton extract_skeleton(const Outline& outline);

}  // namespace partwise
