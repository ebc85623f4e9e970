// Samples of the medial axis of the free space, by any method: configurations are drawn, evenly within the bounds
// or as one says, and retracted, until enough have arrived.
//
// A sample is free and within the bounds whatever the method says. With `only_on_axis` the two smallest distances must
// also differ by at most 2 % (medial_axis.h), which a query each decides: what the method got wrong is not a sample.
// The same samples for any number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/motion/medial_axis.h"

namespace partwise {

struct AxisSamplesSettings {
  int count = 1000;
  bool only_on_axis = true;
  int most_tries = 50;  // configurations drawn a sample that is asked for
  std::uint64_t seed = 0;
  long first = 0;  // number of the first configuration drawn: a later call goes on where an earlier one stopped
  std::function<Configuration(Draw&)> drawn = {};  // left empty: evenly within the bounds
};

struct AxisSample {
  Configuration q;
  AxisState state;
};

struct AxisSamples {
  std::vector<AxisSample> samples;
  long drawn = 0;  // configurations
  long lost = 0;   // of those, given up by the method, not free, outside or (only_on_axis) off the axis
  long steps = 0;  // of the method
  long quick = 0;  // arrived within ten steps
  long distance_queries = 0, collision_checks = 0;

  double share_on_axis() const;
};

AxisSamples axis_samples(const Scene& scene, const Retractor& retract, const AxisSamplesSettings& settings = {},
                         const Progress& progress = {});

}  // namespace partwise
