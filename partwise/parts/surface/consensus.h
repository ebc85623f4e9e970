// One segmentation from many of the same faces: what most of them agree on.
//
// Two faces are as close as the share of the segmentations in which they are together (Fred and Jain 2005, evidence
// accumulation). Faces that are together everywhere are one atom; the largest atoms are merged by average linkage,
// closest first, while the mean closeness of two groups is above `agreement`; the other atoms then join the group that
// they are closest to. At an agreement of 1/2 each merge lowers the mean Rand distance to the given segmentations, so
// that the result lies between them where they differ.
//
// Time O(faces x segmentations + atoms^2 x segmentations). Errors: InputError for segmentations of different lengths
// or none, or an agreement outside [0, 1].
#pragma once

#include <span>
#include <vector>

namespace partwise {

struct ConsensusSettings {
  double agreement = 0.5;
  int largest_atoms = 400;  // how many are merged; the rest is assigned
};

// Labels 0 .. k - 1, numbered by their first face; a group need not be connected.
std::vector<int> consensus_labels(std::span<const std::vector<int>> segmentations,
                                  const ConsensusSettings& settings = {});

}  // namespace partwise
