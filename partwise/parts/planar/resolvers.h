// Resolvers of intolerable features (Liu 2017, section 2.3.3.3.1): smallest sets of diagonals at a vertex that leave no
// local concavity above the tolerance.
//
// Between two neighbouring directions at the vertex v, which end at p and q, the local residual concavity is nothing
// where the angle is at most half a turn, and else the distance of v to the segment p q.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

namespace partwise {

struct Corner {
  Eigen::Vector2d at, next, previous;  // the inside lies from next counter-clockwise to previous
};

// Whether the corner turns back more than the tolerance allows without any diagonal.
bool needs_resolver(const Corner& corner, double tolerance);

// Whether diagonals to `ends`, of which those outside the corner do not count, leave at most the tolerance everywhere.
bool resolves(const Corner& corner, std::span<const Eigen::Vector2d> ends, double tolerance);

// Sets of indices of `ends`: every single one that resolves, and every pair that does while none of its two does.
std::vector<std::vector<int>> smallest_resolvers(const Corner& corner, std::span<const Eigen::Vector2d> ends,
                                                 double tolerance);

}  // namespace partwise
