// Candidate diagonals and the choice among them for one region whose complement has been measured (Liu 2017, section
// 2.3.3.3): the constrained Delaunay triangulations of the simplified polygon and of the region itself, the latter with
// the valid diagonals of the former as constraints. All candidates are edges of that last one, so that no two cross.
// Noise holes count as filled.
#pragma once

#include <span>
#include <vector>

#include "partwise/parts/planar/complement.h"
#include "partwise/parts/planar/cut_selection.h"
#include "partwise/parts/planar/region.h"

namespace partwise {

struct CutSettings {
  double tolerance = 0;
  double radius = 1;  // the unit of lengths in scores
};

struct ChosenCuts {
  std::vector<IndexEdge> diagonals;  // indices of points, each once, smaller index first
  int unresolved = 0;                // features without a resolver among the chosen
  std::vector<Region> pieces;        // split along them, noise holes filled
};

ChosenCuts choose_cuts(std::span<const Point2> points, const Region& region, const Complement& complement,
                       const CutSettings& settings);

// The score of a resolver by its diagonals (2.3): the mean of (1 + c / tolerance) / (length / radius), with c the
// concavity at the far end.
double diagonal_score(double length, double far_concavity, const CutSettings& settings);

}  // namespace partwise
