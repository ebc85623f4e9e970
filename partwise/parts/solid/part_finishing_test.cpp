#include "partwise/parts/solid/part_finishing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/test_solids.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace partwise {
namespace {

using test::block;

void expect_partition(const Mesh& mesh, const std::vector<HullPart>& parts) {
  std::vector<int> faces;
  for (const HullPart& part : parts) {
    EXPECT_FALSE(part.faces.empty());
    EXPECT_TRUE(std::is_sorted(part.faces.begin(), part.faces.end()));
    EXPECT_EQ(connected_groups(mesh, part.faces).size(), 1u);
    EXPECT_LE(test::largest_excess(part.hull, corners_of(mesh, part.faces)), 1e-12);
    faces.insert(faces.end(), part.faces.begin(), part.faces.end());
  }
  std::sort(faces.begin(), faces.end());
  EXPECT_EQ(faces, test::all_faces(mesh));
}

std::vector<HullPart> parts_by(const Mesh& mesh, const std::vector<int>& label) {
  std::map<int, std::vector<int>> groups;
  for (std::size_t f = 0; f < label.size(); ++f) groups[label[f]].push_back(static_cast<int>(f));
  std::vector<HullPart> parts;
  for (auto& [key, faces] : groups)
    for (auto& group : connected_groups(mesh, faces)) parts.push_back(hull_part(mesh, std::move(group), 1e-4));
  return parts;
}

TEST(AbsorbFaces, KeepsPartitionAndConnectivityForRandomLabels) {
  std::mt19937_64 random(1);
  for (const Mesh& mesh : {test::l_shape(5, 2), test::torus(1, 0.4, 20, 10), test::sheet(8, 4)})
    for (int round = 0; round < 10; ++round) {
      std::vector<int> label(static_cast<std::size_t>(mesh.faces.rows()));
      for (int& l : label) l = static_cast<int>(random() % 4);
      std::vector<HullPart> parts = parts_by(mesh, label);
      const std::size_t before = parts.size();
      double largest = 0, largest_after = 0;
      for (const HullPart& part : parts) largest = std::max(largest, part.volume);
      const bool changed = absorb_faces(mesh, parts, 1e-4);
      expect_partition(mesh, parts);
      EXPECT_LE(parts.size(), before);
      for (const HullPart& part : parts) largest_after = std::max(largest_after, part.volume);
      EXPECT_LE(largest_after, largest + 1e-12);  // No hull grows.
      if (parts.size() < before) {
        EXPECT_TRUE(changed);
      }
    }
}

TEST(AbsorbFaces, APatchOnABoxGoesToTheBox) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {4, 4, 4}));
  std::vector<int> label(static_cast<std::size_t>(mesh.faces.rows()), 0);
  for (int f = 10; f < 14; ++f) label[f] = 1;
  std::vector<HullPart> parts = parts_by(mesh, label);
  ASSERT_GE(parts.size(), 2u);
  EXPECT_TRUE(absorb_faces(mesh, parts, 1e-4));
  EXPECT_EQ(parts.size(), 1u);
  expect_partition(mesh, parts);
  EXPECT_FALSE(absorb_faces(mesh, parts, 1e-4));
}

struct Measured {
  explicit Measured(const Mesh& shape)
      : mesh(test::normalised(shape)),
        surface(mesh),
        space(sample_space(surface, convex_hull(mesh.vertices, 1e-6).mesh, 2000)),
        outside(surface, is_watertight(mesh), {Point::Zero(), 1}, 0.01) {}
  Mesh mesh;
  SurfaceQuery surface;
  SpaceSamples space;
  OutsideDistance outside;
};

std::size_t uncovered(const PointTree& points, const std::vector<HullPart>& parts) {
  std::vector<char> covered(static_cast<std::size_t>(points.size()), 0);
  for (const HullPart& part : parts)
    for (int i : points.inside(part.hull)) covered[i] = 1;
  return static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 0));
}

// The six sides of a solid cube as parts of their own: flat hulls that leave the whole inside uncovered.
TEST(FillInterior, SidesOfACubeGrowOverItsInside) {
  Measured m(test::cells_mesh(block({0, 0, 0}, {4, 4, 4})));
  std::vector<int> label;
  for (int f = 0; f < m.mesh.faces.rows(); ++f) {
    const Point a = m.mesh.vertices.row(m.mesh.faces(f, 0));
    const Point normal =
        Point(m.mesh.vertices.row(m.mesh.faces(f, 1)) - a).cross(Point(m.mesh.vertices.row(m.mesh.faces(f, 2)) - a));
    Eigen::Index axis;
    normal.cwiseAbs().maxCoeff(&axis);
    label.push_back(2 * static_cast<int>(axis) + (normal[axis] > 0));
  }
  std::vector<HullPart> parts = parts_by(m.mesh, label);
  ASSERT_EQ(parts.size(), 6u);
  EXPECT_GT(uncovered(m.space.solid, parts), 1500u);
  const HullPromise promise(m.outside, 0.1, 0);
  fill_interior(m.mesh, m.space, parts, promise, 1e-4);
  EXPECT_EQ(uncovered(m.space.solid, parts), 0u);
  EXPECT_EQ(parts.size(), 6u);
  for (const HullPart& part : parts) EXPECT_TRUE(promise.holds(part.hull));
}

// Two halves of the inner and the outer wall of a hollow box; the cavity may not be filled.
TEST(FillInterior, NoHullGrowsAgainstItsPromise) {
  Measured m(test::cells_mesh(test::without(block({0, 0, 0}, {6, 6, 6}), block({1, 1, 1}, {5, 5, 5}))));
  std::vector<int> label;
  for (int f = 0; f < m.mesh.faces.rows(); ++f) {
    const Point centre = m.mesh.vertices(m.mesh.faces.row(f), Eigen::all).colwise().mean();
    Eigen::Index axis;
    const double far = centre.cwiseAbs().maxCoeff(&axis);
    label.push_back((2 * static_cast<int>(axis) + (centre[axis] > 0)) * 2 + (far > 0.5));
  }
  std::vector<HullPart> parts = parts_by(m.mesh, label);
  const HullPromise promise(m.outside, 0.05, 0);
  std::vector<double> reach;
  for (const HullPart& part : parts) reach.push_back(promise.reach(part.hull).distance);
  const std::size_t before = uncovered(m.space.solid, parts);
  fill_interior(m.mesh, m.space, parts, promise, 1e-4);
  EXPECT_LT(uncovered(m.space.solid, parts), before);
  for (std::size_t p = 0; p < parts.size(); ++p)
    EXPECT_LE(promise.reach(parts[p].hull).distance, std::max(0.05, reach[p]) + 0.02);
  expect_partition(m.mesh, parts);
}

TEST(FillInterior, AnOpenSurfaceHasNothingToFill) {
  Measured m(test::sheet(6, 3));
  std::vector<HullPart> parts = parts_by(m.mesh, std::vector<int>(static_cast<std::size_t>(m.mesh.faces.rows()), 0));
  const double volume = parts[0].volume;
  fill_interior(m.mesh, m.space, parts, HullPromise(m.outside, 10, 0), 1e-4);
  EXPECT_EQ(parts[0].volume, volume);
}

}  // namespace
}  // namespace partwise
