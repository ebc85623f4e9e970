#include "partwise/appearance/colouring.h"

#include <gtest/gtest.h>

#include <array>

#include "partwise/appearance/palette.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

Mesh fan() {  // three faces about the first vertex
  Mesh mesh;
  mesh.vertices.resize(5, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0;
  mesh.faces.resize(3, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3, 0, 3, 4;
  return mesh;
}

TEST(Colouring, FacesHaveTheColoursOfTheirParts) {
  const PreviewMesh coloured = coloured_by_part(fan(), std::array{1, 0, 1});
  EXPECT_EQ(coloured.face_colours, (std::vector{part_colour(1), part_colour(0), part_colour(1)}));
  EXPECT_THROW(coloured_by_part(fan(), std::array{1, 0}), CheckFailed);
}

TEST(Colouring, FacesReachBothEndsOfTheScale) {
  const PreviewMesh coloured = coloured_by_value(fan(), Eigen::Vector3d(7, -3, 2));
  EXPECT_EQ(coloured.face_colours, (std::vector{value_colour(1), value_colour(0), value_colour(0.5f)}));
  EXPECT_THROW(coloured_by_value(fan(), Eigen::Vector2d(7, -3)), CheckFailed);
}

TEST(Colouring, EqualValuesHaveTheColourOfTheLeast) {
  for (const Eigen::Vector3f& colour : coloured_by_value(fan(), Eigen::Vector3d::Constant(4)).face_colours)
    EXPECT_EQ(colour, value_colour(0));
}

TEST(Colouring, PointsOfLikeValueAreOneMember) {
  const Vertices points = fan().vertices.topRows(4);
  const std::vector<PreviewPoints> coloured = coloured_by_value(points, std::array{2.0, 8.0, 2.0 + 1e-9, 8.0}, 0.25);
  ASSERT_EQ(coloured.size(), 2u);
  for (const std::size_t member : {0u, 1u}) {
    EXPECT_EQ(coloured[member].colour, value_colour(static_cast<float>(member)));
    EXPECT_EQ(coloured[member].radius, 0.25);
    ASSERT_EQ(coloured[member].points.rows(), 2);
    for (const int i : {0, 1}) EXPECT_EQ(coloured[member].points.row(i), points.row(static_cast<int>(member) + 2 * i));
  }
  EXPECT_TRUE(coloured_by_value(Vertices(0, 3), {}, 0.25).empty());
}

}  // namespace
}  // namespace partwise
