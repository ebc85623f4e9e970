#include "partwise/parts/applications/repair.h"

#include <gtest/gtest.h>

#include <random>

#include "partwise/base/error.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

Mesh without_faces(const Mesh& mesh, double share, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  Mesh broken = mesh;
  Eigen::Index kept = 0;
  for (const auto& face : mesh.faces.rowwise())
    if (unit(random) >= share) broken.faces.row(kept++) = face;
  broken.faces.conservativeResize(kept, 3);
  return broken;
}

TEST(Repair, AMeshWithoutNearlyHalfOfItsFacesIsWholeAgain) {
  for (const Mesh& intact : {test::dumbbell(40), test::torus(1, 0.35, 72, 30)}) {
    const Mesh broken = without_faces(intact, 0.45, 1);
    ASSERT_FALSE(is_watertight(broken));
    const Repair result = repair(broken);
    EXPECT_TRUE(is_watertight(result.mesh));
    EXPECT_LE(result.reach, 0.1);
    const RepairLoss loss = repair_loss(result.mesh, intact);
    EXPECT_LE(loss.added, 0.1);
    EXPECT_LE(loss.lost, 0.1);
    EXPECT_LT(loss.volume_lost, 0.01);
    // All vertices that are left lie inside.
    const SurfaceQuery solid(result.mesh);
    for (const auto& f : broken.faces.rowwise()) EXPECT_TRUE(solid.contains(broken.vertices.row(f[0])));
  }
}

TEST(Repair, LossIsWhatWasLost) {
  const Mesh large = test::cells_mesh(test::block({0, 0, 0}, {4, 2, 2})),
             small = test::cells_mesh(test::block({0, 0, 0}, {3, 2, 2}));
  const double radius = bounding_sphere(large).radius;
  const RepairLoss lost = repair_loss(small, large);
  EXPECT_NEAR(lost.lost, 1 / radius, 0.003);
  EXPECT_NEAR(lost.volume_lost, 0.25, 1e-9);
  EXPECT_EQ(lost.volume_added, 0);
  const RepairLoss added = repair_loss(large, small);
  EXPECT_THROW(repair_loss(large, small, {{}, [] { return true; }}), Cancelled);
  EXPECT_NEAR(added.added, 1 / bounding_sphere(small).radius, 0.003);
  EXPECT_NEAR(added.volume_added, 1 / 3.0, 1e-9);
  EXPECT_LE(added.lost, 0.003);
}

TEST(Repair, RefusesWhatItCannotDo) {
  EXPECT_THROW(repair(test::l_shape(4, 2), {.tolerance = 0.001}), InputError);
  EXPECT_THROW(repair(test::l_shape(4, 2), {.max_faces = 4}), InputError);
  EXPECT_THROW(repair_loss(test::l_shape(4, 2), test::open_cup(1, 1, 12)), InputError);
}

}  // namespace
}  // namespace partwise
