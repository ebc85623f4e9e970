// A short list of what is nearest to obstacles so far: nearest first, of equally near ones the lower number first.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace partwise {

// `Found` has a distance and an obstacle. At most `wanted` stay.
template <typename Found>
void insert_nearest(std::vector<Found>& list, const Found& next, std::size_t wanted) {
  const auto nearer = [](const Found& a, const Found& b) {
    return std::pair(a.distance, a.obstacle) < std::pair(b.distance, b.obstacle);
  };
  list.insert(std::ranges::upper_bound(list, next, nearer), next);
  if (list.size() > wanted) list.pop_back();
}

}  // namespace partwise
