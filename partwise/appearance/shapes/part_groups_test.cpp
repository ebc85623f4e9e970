#include "partwise/appearance/shapes/part_groups.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <numbers>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// A box as twelve faces, turned about y, its middle at `centre`; its faces get the next label.
void add_box(Mesh& mesh, std::vector<int>& parts, const Point& size, const Point& centre, double turn = 0) {
  constexpr int corners[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                  {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  const Eigen::Matrix3d rotation = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Eigen::Index vertices = mesh.vertices.rows(), faces = mesh.faces.rows();
  mesh.vertices.conservativeResize(vertices + 8, 3);
  mesh.faces.conservativeResize(faces + 12, 3);
  for (int i = 0; i < 8; ++i) {
    const Point corner((i & 1) - 0.5, (i >> 1 & 1) - 0.5, (i >> 2 & 1) - 0.5);
    mesh.vertices.row(vertices + i) = corner.cwiseProduct(size) * rotation.transpose() + centre;
  }
  const int part = parts.empty() ? 0 : parts.back() + 1;
  for (int i = 0; i < 12; ++i) {
    for (int k = 0; k < 3; ++k) mesh.faces(faces + i, k) = static_cast<int>(vertices) + corners[i][k];
    parts.push_back(part);
  }
}

// A chair: four legs that are turned and a little different, a seat, a back, and two screws in the back.
struct Chair {
  Mesh mesh;
  std::vector<int> parts;

  Chair() {
    for (int leg = 0; leg < 4; ++leg)
      add_box(mesh, parts, Point(0.05, 0.5 + 0.005 * leg, 0.05), Point(leg % 2 * 0.4, 0.25, leg / 2 * 0.4), 0.3 * leg);
    add_box(mesh, parts, Point(0.5, 0.05, 0.5), Point(0.2, 0.53, 0.2));
    add_box(mesh, parts, Point(0.45, 0.6, 0.04), Point(0.2, 0.9, 0.0));
    add_box(mesh, parts, Point(0.01, 0.01, 0.02), Point(0.1, 1.0, 0.03));
    add_box(mesh, parts, Point(0.01, 0.02, 0.01), Point(0.3, 1.0, 0.03));
  }

  std::vector<int> groups(int target) const {  // of legs, seat, back, screws
    const PartGroups found = group_parts(mesh, parts, target);
    std::vector<int> of_part;
    for (std::size_t f = 0; f < parts.size(); f += 12) {
      for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(found.of_face[f + i], found.of_face[f]);
      of_part.push_back(found.of_face[f]);
    }
    return of_part;
  }
};

TEST(PartGroups, PartsThatLookAlikeAreOne) {
  EXPECT_EQ(Chair().groups(10), (std::vector<int>{0, 0, 0, 0, 1, 2, 3, 3}));
}

TEST(PartGroups, TheSmallestJoinsWhatItLiesAt) {
  EXPECT_EQ(Chair().groups(3), (std::vector<int>{0, 0, 0, 0, 1, 2, 2, 2}));
  EXPECT_EQ(Chair().groups(2), (std::vector<int>{0, 0, 0, 0, 0, 1, 1, 1}));  // legs to the seat
  EXPECT_EQ(Chair().groups(1), (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 0}));
}

TEST(PartGroups, DoNotDependOnPlaceTurnAndSize) {
  const Chair chair;
  Chair moved = chair;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  moved.mesh.vertices = ((40 * moved.mesh.vertices * turn.transpose()).rowwise() + Point(5, -7, 100)).eval();
  for (const int target : {1, 2, 3, 4}) EXPECT_EQ(moved.groups(target), chair.groups(target));
}

TEST(PartGroups, LabelsMayBeAnyNumbers) {
  Chair chair;
  const std::vector<int> before = chair.groups(3);
  for (int& part : chair.parts) part = 1000 - 3 * part;
  EXPECT_EQ(chair.groups(3), before);
}

TEST(PartGroups, RefusesWhatDoesNotFit) {
  Chair chair;
  EXPECT_THROW(group_parts(chair.mesh, chair.parts, 0), InputError);
  chair.parts.pop_back();
  EXPECT_THROW(group_parts(chair.mesh, chair.parts, 3), InputError);
}

}  // namespace
}  // namespace partwise
