#include "partwise/motion/medial_axis.h"

namespace partwise {

AxisState axis_state(const Scene& scene, const Configuration& q) {
  constexpr int looked_at = 6;
  AxisState state;
  state.free = scene.free(q);
  for (const Near& each : scene.nearest(q, looked_at)) {
    if (state.pair[0].obstacle < 0) {
      state.pair[0] = each;
    } else if ((each.gradient - state.pair[0].gradient).norm() >= least_separation) {
      state.pair[1] = each;
      break;
    }
  }
  return state;
}

}  // namespace partwise
