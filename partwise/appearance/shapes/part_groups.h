// Few groups from many parts, for putting materials on: the four legs of a chair should wear one.
//
// Parts that look alike are one group: those whose areas and whose principal second moments of area agree, as lengths,
// within 10 %. Then, while there are more groups than wanted, the group of least area joins the group
// that it lies closest to, by the mean distance from the corners of its faces to the nearest vertex of the other (ties:
// the group that comes first). So screws join what they hold, and a wheel its tyre. The rule stands in for the merging
// by hand of Liu 2017, section 3.3.4.
//
// Time O(parts^2) comparisons and, for a join, O(n log n) for n vertices. Deterministic. Errors: InputError for labels
// that are not one a face or are negative, or a target below 1.
#pragma once

#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

struct PartGroups {
  std::vector<int> of_face;  // 0 .. count - 1, numbered by their first face
  int count = 0;             // at most the target; fewer where there are fewer parts or all look alike
};

PartGroups group_parts(const Mesh& mesh, std::span<const int> part_of_face, int target);

}  // namespace partwise
