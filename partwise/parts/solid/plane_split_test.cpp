#include "partwise/parts/solid/plane_split.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "partwise/parts/solid/hull_part.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

using test::block;

std::vector<int> sorted_union(const std::vector<std::vector<int>>& groups) {
  std::vector<int> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  std::sort(all.begin(), all.end());
  return all;
}

TEST(SplitByPlane, CutsAnLAtItsCorner) {
  const Mesh mesh = test::l_shape(10, 3);
  const auto pieces = split_by_plane(mesh, test::all_faces(mesh), Point(3, 3, 1), 1e-4);
  EXPECT_GE(pieces.size(), 2u);
  EXPECT_EQ(sorted_union(pieces), test::all_faces(mesh));
}

TEST(SplitByPlane, AlwaysDividesTwoFacesAndMore) {
  Mesh mesh = test::cells_mesh(block({0, 0, 0}, {1, 1, 1}));
  EXPECT_GE(split_by_plane(mesh, test::all_faces(mesh), Point(50, 50, 50), 1e-4).size(), 2u);
  mesh.vertices.setZero();  // No plane tells these apart.
  const auto single = split_by_plane(mesh, test::all_faces(mesh), Point::Zero(), 1e-4);
  EXPECT_EQ(single.size(), static_cast<std::size_t>(mesh.faces.rows()));
}

TEST(Halve, CutsABarAcross) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {6, 1, 1}));
  const auto halves = halve(mesh, test::all_faces(mesh));
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_EQ(sorted_union(halves), test::all_faces(mesh));
  for (const auto& half : halves) {
    const Eigen::VectorXd x = corners_of(mesh, half).col(0);
    EXPECT_EQ(x.maxCoeff() - x.minCoeff(), 3);
  }
}

TEST(Halve, LeavesWhatHasNoExtentWhole) {
  Mesh mesh = test::cells_mesh(block({0, 0, 0}, {1, 1, 1}));
  mesh.vertices.setZero();
  EXPECT_EQ(halve(mesh, test::all_faces(mesh)).size(), 1u);
}

}  // namespace
}  // namespace partwise
