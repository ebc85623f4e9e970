#include <gtest/gtest.h>

#include <numbers>

#include "drop.h"
#include "partwise/base/error.h"
#include "partwise/base/shared_files.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/solid/decompose.h"

namespace {

partwise::Mesh box(const partwise::Point& low, const partwise::Point& high) {
  partwise::Vertices corners(8, 3);
  for (int i = 0; i < 8; ++i) {
    corners.row(i) << (i & 1 ? high : low).x(), (i & 2 ? high : low).y(), (i & 4 ? high : low).z();
  }
  return partwise::convex_hull(corners, 1e-6).mesh;
}

TEST(Compound, MassAndInertiaOfTwoBoxes) {
  // A 4 x 1 x 1 bar in two halves, off the origin: m = 4, I = m (b^2 + c^2) / 12.
  const std::vector<partwise::Mesh> halves{box({5, 2, 1}, {7, 3, 2}), box({7, 2, 1}, {9, 3, 2})};
  const Compound bar = make_compound(halves, 1, 1);
  EXPECT_NEAR(bar.mass, 4, 1e-5);
  EXPECT_NEAR(bar.inertia.x(), 4.0 * 2 / 12, 1e-5);
  EXPECT_NEAR(bar.inertia.y(), 4.0 * 17 / 12, 1e-5);
  EXPECT_NEAR(bar.inertia.z(), 4.0 * 17 / 12, 1e-5);
  EXPECT_LT((bar.world(btTransform::getIdentity(), {7, 2.5, 1.5})).length(), 1e-5);
  const Compound half_size = make_compound(halves, 0.5, 1);
  EXPECT_NEAR(half_size.mass, 0.5, 1e-6);
  EXPECT_NEAR(half_size.inertia.z(), bar.inertia.z() / 32, 1e-6);
  EXPECT_THROW(make_compound({}), partwise::InputError);
}

class DropModel : public testing::TestWithParam<const char*> {};

TEST_P(DropModel, ComesToRestOnTheFloor) {
  const partwise::Mesh mesh = partwise::read_mesh(partwise::shared_file(std::string("data/models/") + GetParam()));
  const partwise::Decomposition parts = partwise::decompose(mesh);
  const Compound compound = make_compound(parts.hulls, 1 / parts.radius);
  const Drop result = drop(compound, parts.hulls);
  EXPECT_TRUE(result.rested);
  EXPECT_LT(result.seconds, 8);
  EXPECT_GT(result.lowest, -0.01);  // one per cent of the bounding sphere's radius: not sunk in,
  EXPECT_LT(result.lowest, 0.01);   // and not afloat
  EXPECT_LT(result.last_wobble, 0.2 * std::numbers::pi / 180);
}

INSTANTIATE_TEST_SUITE_P(Shipped, DropModel, testing::Values("table.obj", "horse.ply"));

}  // namespace
