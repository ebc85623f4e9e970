#include "partwise/geometry/farthest_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "partwise/base/error.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

TEST(FarthestPoint, IsACertifiedBound) {
  const Mesh inner = test::box({-1, -1, -1}, {1, 1, 1}), outer = test::box({-2, -1, -1}, {3, 1, 1});
  const SurfaceQuery to_inner(inner);
  for (const double precision : {0.1, 1e-2, 1e-4}) {
    const double reach = farthest_point(
        outer, [&](const Point& p) { return to_inner.distance(p); }, precision);
    EXPECT_GE(reach, 2 - 1e-6);
    EXPECT_LE(reach, 2 + precision + 1e-6);
  }
}

TEST(FarthestPoint, FindsAPeakInTheMiddleOfAFace) {
  const Mesh box = test::box({-1, -1, -1}, {1, 1, 1});
  const Point peak(1, 0.123, -0.456);
  const double reach = farthest_point(
      box, [&](const Point& p) { return std::max(0.0, 0.01 - (p - peak).norm()); }, 1e-5);
  EXPECT_GE(reach, 0.01);
  EXPECT_LE(reach, 0.01 + 1e-5);
  EXPECT_THROW(farthest_point(
                   box, [](const Point&) { return 0.0; }, 0),
               InputError);
}

}  // namespace
}  // namespace partwise
