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
// connected() joins what is there. A GrowingRoadmap is given more and more, until a path is found (axis_planner.h):
// new samples are joined to all, then components as before, and endpoints to their nearest neighbours anew. After
// Cancelled it goes on where it was.
//
// The same for any number of threads. Errors: Cancelled.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/motion/axis_samples.h"
#include "partwise/motion/motion_path.h"

namespace partwise {

struct RoadmapSettings {
  int neighbours = 8;  // of each sample, by embedded distance
  bool push = true;    // edges; else all are straight
  bool cycles = true;  // else what is joined already by way of others is left out, for want of time
  int depth = 6;
  double resolution = 1e-5;  // share of the bounds' diagonal
  std::uint64_t seed = 0;
};

struct RoadmapEdge {
  int from = 0, to = 0;                // samples, from < to
  std::vector<Configuration> between;  // where it bends, on the axis
  double length = 0;                   // displacement
  double clearance = 0;                // the smallest that is known: at its ends, its bends, and where it was checked
};

struct Roadmap {
  std::vector<RoadmapEdge> edges;  // by from, then to
  int components = 0;              // of samples that edges join
  long distance_queries = 0;
};

class GrowingRoadmap {
 public:
  // Which must outlive this.
  GrowingRoadmap(const Scene& scene, const Retractor& retract, const RoadmapSettings& settings = {});
  ~GrowingRoadmap();

  // A configuration that paths start or end at, free and within the bounds; its number among the samples.
  int add_endpoint(const Configuration& q);
  void add(const std::vector<AxisSample>& samples, const Progress& progress = {});
  // Without cycles: the edges that were left out between samples that the path passes and neighbours of these, so that
  // there is something to choose from. False where none was.
  bool add_cycles(const MotionPath& path, const Progress& progress = {});

  const std::vector<AxisSample>& samples() const;  // endpoints among them
  const Roadmap& roadmap() const;                  // of all that was added before the last add()

 private:
  struct State;
  std::unique_ptr<State> state_;
};

Roadmap connected(const Scene& scene, const std::vector<AxisSample>& samples, const Retractor& retract,
                  const RoadmapSettings& settings = {}, const Progress& progress = {});

}  // namespace partwise
