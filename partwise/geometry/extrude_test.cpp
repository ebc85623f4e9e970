#include "partwise/geometry/extrude.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <utility>

namespace partwise {
namespace {

Ring ring(std::initializer_list<std::array<double, 2>> corners) {
  Ring result(static_cast<Eigen::Index>(corners.size()), 2);
  Eigen::Index i = 0;
  for (const auto& corner : corners) result.row(i++) << corner[0], corner[1];
  return result;
}

// Every side of a face is passed as often one way as the other.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> passed;
  for (const auto& face : mesh.faces.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      passed[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::ranges::all_of(passed, [](const auto& each) { return each.second == 0; });
}

TEST(Extrude, ASquareBecomesABox) {
  const Mesh box = prism({ring({{0, 0}, {2, 0}, {2, 3}, {0, 3}}), {}}, -1, 4);
  EXPECT_EQ(box.vertices.rows(), 8);
  EXPECT_EQ(box.faces.rows(), 12);
  EXPECT_TRUE(is_closed(box));
  EXPECT_DOUBLE_EQ(signed_volume(box), 2 * 3 * 5);
}

TEST(Extrude, VolumeIsAreaTimesHeightWithHolesAndHollows) {
  const Polygon polygon = {ring({{0, 0}, {10, 0}, {10, 10}, {5, 4}, {0, 10}}),
                           {ring({{2, 2}, {2, 3}, {3, 3}, {3, 2}})}};
  const Mesh mesh = prism(polygon, 0, 0.5);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(signed_volume(mesh), 0.5 * area(polygon), 1e-12);
}

TEST(Extrude, AHoleThatTouchesTheOuterRingSharesItsCorner) {
  const Polygon polygon = {ring({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {ring({{0, 0}, {1, 2}, {2, 1}})}};
  const Mesh mesh = prism(polygon, 0, 1);
  EXPECT_EQ(mesh.vertices.rows(), 2 * 6);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_NEAR(signed_volume(mesh), area(polygon), 1e-12);
}

}  // namespace
}  // namespace partwise
