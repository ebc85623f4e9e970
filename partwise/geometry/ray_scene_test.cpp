#include "partwise/geometry/ray_scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "partwise/geometry/mesh.h"

namespace partwise {
namespace {

// Embree devices can be told how many threads to use, and hold all of TBB to that number.
TEST(RayScene, LeavesTheProgramItsThreads) {
  constexpr auto parallelism = tbb::global_control::max_allowed_parallelism;
  const tbb::global_control five(parallelism, 5);
  Vertices vertices(3, 3);
  vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  Faces faces(1, 3);
  faces << 0, 1, 2;
  const RayScene scene(vertices, faces, RTC_SCENE_FLAG_ROBUST);
  EXPECT_EQ(tbb::global_control::active_value(parallelism), 5u);
}

}  // namespace
}  // namespace partwise
