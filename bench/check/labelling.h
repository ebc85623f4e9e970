// Do the labels name parts, and do the hulls hold them?
#pragma once

#include <vector>

#include "bench/check/hull.h"
#include "bench/check/shape.h"

namespace partwise::bench {

struct Labelling {
  int parts = 0;                // distinct labels
  bool complete = false;        // one label a face, from 0 on, none left out
  bool parts_connected = true;  // within a part a path from face to face by shared vertices
  double hull_outside = 0;      // model units: largest distance of a part's vertex outside the hull of the same number
  int worst_part = -1;
  double outside_all = 0;   // model units: the same, outside the nearest hull of all
  bool hulls_match = true;  // no other hull holds a part better, by more than `slack`, than the one of its number
};

Labelling judge_labels(const Shape& shape, const std::vector<int>& labels, const std::vector<Hull>& hulls,
                       double slack);  // slack: model units, for rounding

}  // namespace partwise::bench
