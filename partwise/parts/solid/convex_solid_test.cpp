#include "partwise/parts/solid/convex_solid.h"

#include <gtest/gtest.h>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/decompose.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

using test::block;
using test::cells_mesh;

std::optional<Mesh> found(const Mesh& mesh, double minimum_thickness) {
  return convex_solid(mesh, bounding_sphere(mesh), minimum_thickness);
}

TEST(ConvexSolid, IsItsOwnHull) {
  Mesh box = cells_mesh(block({1, 2, 3}, {4, 6, 9}));
  const auto hull = found(box, 1e-6);
  ASSERT_TRUE(hull);
  EXPECT_NEAR(signed_volume(*hull), 3 * 4 * 6, 1e-9);
  EXPECT_TRUE(is_watertight(*hull));

  box.vertices.conservativeResize(box.vertices.rows() + 1, 3);
  box.vertices.bottomRows<1>() << 100, 100, 100;  // of no face
  EXPECT_TRUE(found(box, 1e-6));
  const Decomposition whole = decompose(box, {.tolerance = 0.1});
  EXPECT_EQ(whole.parts(), 1);
  EXPECT_EQ(whole.concavity, 0);
  EXPECT_EQ(whole.volume_ratio, 1);
  EXPECT_LT(whole.hulls[0].vertices.maxCoeff(), 10);
}

TEST(ConvexSolid, IsClosedConnectedAndTurnedOutwards) {
  EXPECT_FALSE(found(cells_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), 1e-6));  // an L
  const Mesh box = cells_mesh({{0, 0, 0}});
  ASSERT_EQ(box.faces.rows(), 12);
  EXPECT_FALSE(found({box.vertices, box.faces.topRows(11)}, 1e-6));
  EXPECT_FALSE(found({box.vertices, box.faces.rowwise().reverse()}, 1e-6));
  EXPECT_FALSE(found(box, 2));  // thinner than hulls may be

  // Twice the same box, which share no vertex: two parts.
  Mesh twice = box;
  twice.vertices.conservativeResize(16, 3);
  twice.vertices.bottomRows(8) = box.vertices;
  twice.faces.conservativeResize(24, 3);
  twice.faces.bottomRows(12) = box.faces.array() + 8;
  EXPECT_FALSE(found(twice, 1e-6));
}

// A dent of a millionth is a dent.
TEST(ConvexSolid, SeesSmallDents) {
  const Mesh box = cells_mesh({{0, 0, 0}});
  ASSERT_EQ(box.faces.rows(), 12);
  Mesh dented = box;
  dented.vertices.conservativeResize(9, 3);
  dented.vertices.row(8) = dented.vertices.topRows(8).colwise().mean();
  const Eigen::RowVector3i face = box.faces.row(0);
  const Point middle = (box.vertices.row(face[0]) + box.vertices.row(face[1]) + box.vertices.row(face[2])) / 3;
  dented.vertices.row(8) = middle + 1e-6 * (dented.vertices.row(8) - middle);
  dented.faces.conservativeResize(14, 3);
  dented.faces.row(0) << face[0], face[1], 8;
  dented.faces.row(12) << face[1], face[2], 8;
  dented.faces.row(13) << face[2], face[0], 8;
  EXPECT_TRUE(found(box, 1e-9));
  EXPECT_FALSE(found(dented, 1e-9));
}

TEST(ConvexSolid, MayBeHugeOrTiny) {
  for (const double scale : {1e-150, 1e150}) {
    Mesh box = cells_mesh({{0, 0, 0}});
    box.vertices *= scale;
    const auto hull = found(box, 1e-6);
    ASSERT_TRUE(hull);
    EXPECT_EQ(hull->vertices.maxCoeff(), scale);
  }
}

}  // namespace
}  // namespace partwise
