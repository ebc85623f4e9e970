// A roadmap along the medial axis: samples joined to their nearest neighbours by motions that are free and stay near
// the axis (Liu 2017, section 5.3.3; section 5.1 names what MAPRM lacks, edges that keep clearance).
//
// An edge no longer than the clearance of its ends is straight: half that clearance is left anywhere on it. A longer
// one has its middle pushed to the axis, and so on for the halves, at most `depth` times; where the middle has no way
// to the axis, or a long one, the edge stays straight, if that is free. Every piece of every edge is free by
// certificate (free_motion.h).
//
// Samples come in clusters, whose nearest neighbours are each other. So components are then joined to each other, by
// the nearest samples of each two that lie next to each other, until no further edge is found.
//
// The same for any number of threads. Errors: Cancelled.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/motion/axis_samples.h"

namespace partwise {

struct RoadmapSettings {
  int neighbours = 8;  // of each sample, by embedded distance
  bool push = true;    // edges; else all are straight
  int depth = 6;
  double resolution = 1e-5;  // share of the bounds' diagonal
  std::uint64_t seed = 0;
};

struct RoadmapEdge {
  int from = 0, to = 0;                // samples, from < to
  std::vector<Configuration> between;  // where it bends, on the axis
};

struct Roadmap {
  std::vector<RoadmapEdge> edges;  // by from, then to
  int components = 0;              // of samples that edges join
  long distance_queries = 0;
};

Roadmap connected(const Scene& scene, const std::vector<AxisSample>& samples, const Retractor& retract,
                  const RoadmapSettings& settings = {}, const Progress& progress = {});

}  // namespace partwise
