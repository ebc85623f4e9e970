#include "partwise/parts/surface/shape_diameter.h"

#include <CGAL/mesh_segmentation.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/subdivide.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

Eigen::VectorXd raw(const Mesh& mesh) { return shape_diameter(mesh, {.smoothing = 0}).values; }

Eigen::VectorXd by_cgal(const Mesh& mesh) {
  test::CgalMesh cgal = test::cgal_mesh(mesh);
  auto map = cgal.add_property_map<test::CgalMesh::Face_index, double>("f:sdf").first;
  CGAL::sdf_values(cgal, map, 2.0 / 3 * CGAL_PI, 25, false);
  Eigen::VectorXd values(mesh.faces.rows());
  for (const auto face : cgal.faces()) values[face.idx()] = map[face];
  return values;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd x = a.array() - a.mean(), y = b.array() - b.mean();
  return x.dot(y) / (x.norm() * y.norm());
}

// The spiral of rays about the axis: the angle of ray i of n, by its radius in the disk.
double angle(int i, int n) {
  const double half = std::numbers::pi / 3;
  return std::atan(std::sin(half) * i / n / std::cos(half));
}

// The mean over the rays of what they measure, with the outliers left out.
template <typename Length>
double expected(const Length& length, int n = 25) {
  std::vector<double> all;
  for (int i = 0; i < n; ++i) all.push_back(length(angle(i, n)));
  const double middle = median(all);
  std::vector<double> deviation;
  for (double x : all) deviation.push_back(std::abs(x - middle));
  const double bound = 1.5 * median(deviation);
  std::erase_if(all, [&](double x) { return std::abs(x - middle) > bound; });
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

TEST(ShapeDiameter, OfASphereIsAChordEverywhere) {
  const double radius = 3;
  const Eigen::VectorXd values = raw(test::sphere(radius, 60));
  const double chord = expected([&](double a) { return 2 * radius * std::cos(a); });
  // A ray at the bound of the outliers falls in or out with the shape of the triangle that it meets.
  EXPECT_NEAR(values.mean(), chord, 0.015 * chord);
  EXPECT_LT((values.array() - chord).abs().maxCoeff(), 0.03 * chord);
}

TEST(ShapeDiameter, OfAWideSlabGrowsWithTheSlope) {
  const Mesh slab = split_long_edges(test::box(Point(-50, -50, 0), Point(50, 50, 1)), 6, 100000).mesh;
  const Eigen::VectorXd values = raw(slab);
  const double length = expected([](double a) { return 1 / std::cos(a); });
  int inner = 0;
  for (Eigen::Index f = 0; f < values.size(); ++f) {
    const Point middle = slab.vertices(slab.faces.row(f), Eigen::all).colwise().mean();
    if (std::max(std::abs(middle.x()), std::abs(middle.y())) > 40) continue;
    EXPECT_NEAR(values[f], length, 1e-4);
    ++inner;
  }
  EXPECT_GT(inner, 1000);
}

TEST(ShapeDiameter, OfALongCylinderIsTheSameAllAlong) {
  // A ray at angle a to the axis of the cone, b about it: of the cross-section's plane it sees the direction
  // (cos a, sin a cos b), so that it is 2 cos a / (cos^2 a + sin^2 a cos^2 b) long for radius 1.
  const double golden = (3 - std::sqrt(5.0)) * std::numbers::pi;
  std::vector<double> all;
  const auto height = [](double t) { return 40 * t; };
  const auto radius = [](double t) { return t > 0 && t < 1 ? 1.0 : 0.0; };
  const Mesh cylinder = test::revolved(radius, height, 80, 60);
  const Eigen::VectorXd values = raw(cylinder);
  double low = 1e9, high = 0;
  for (Eigen::Index f = 0; f < values.size(); ++f) {
    const double z = cylinder.vertices(cylinder.faces.row(f), Eigen::all).colwise().mean()[2];
    if (std::abs(z - 20) > 12) continue;
    low = std::min(low, values[f]), high = std::max(high, values[f]);
  }
  // How the spiral lies about the axis differs from face to face: bounds over all turns of it.
  double least = 1e9, most = 0;
  for (double turn = 0; turn < std::numbers::pi; turn += 0.01) {
    int i = 0;
    const double value = expected([&](double a) {
      const double b = golden * i++ + turn, c = std::cos(a), s = std::sin(a) * std::cos(b);
      return 2 * c / (c * c + s * s);
    });
    least = std::min(least, value), most = std::max(most, value);
  }
  EXPECT_GT(low, 0.99 * least);
  EXPECT_LT(high, 1.01 * most);
  EXPECT_LT(most, 1.25 * least);
}

TEST(ShapeDiameter, IsWhatCgalMeasures) {
  struct Case {
    Mesh mesh;
    double
        correlation;  // at least; a torus has the same value everywhere but for noise, so that there is none to ask for
  };
  const Case cases[] = {{test::dumbbell(60, 40), 0.97},
                        {split_long_edges(test::box(Point(0, 0, 0), Point(4, 2, 1)), 0.3, 100000).mesh, 0.9},
                        {test::torus(2, 0.5, 60, 24), -1}};
  for (const auto& [mesh, least] : cases) {
    const Eigen::VectorXd ours = raw(mesh), theirs = by_cgal(mesh);
    std::vector<double> difference;
    for (Eigen::Index f = 0; f < ours.size(); ++f) difference.push_back(std::abs(ours[f] - theirs[f]) / theirs[f]);
    EXPECT_LT(median(difference), 0.02);
    EXPECT_GT(correlation(ours, theirs), least);
  }
}

TEST(ShapeDiameter, ScalesWithTheMesh) {
  const Mesh mesh = test::dumbbell(30, 20);
  Mesh large = mesh;
  large.vertices = 1000 * mesh.vertices;
  large.vertices.rowwise() += Point(5000, 0, 0);
  const Eigen::VectorXd a = shape_diameter(mesh).values, b = shape_diameter(large).values / 1000;
  EXPECT_GT(correlation(a, b), 0.999);
}

TEST(ShapeDiameter, FillsInWhereNoRayMeetsABackFace) {
  // A bowl: rays from its inside leave into the open or meet the bowl from its front.
  Mesh bowl = test::sphere(1, 20);
  std::vector<int> kept;
  for (int f = 0; f < bowl.faces.rows(); ++f)
    if (bowl.vertices(bowl.faces.row(f), Eigen::all).col(2).maxCoeff() < 0.5) kept.push_back(f);
  bowl.faces = Faces(bowl.faces(kept, Eigen::all));
  const Faces outward = bowl.faces;
  EXPECT_EQ(shape_diameter(bowl).missing, 0);
  bowl.faces.col(1) = outward.col(2), bowl.faces.col(2) = outward.col(1);
  const ShapeDiameter inside_out = shape_diameter(bowl);
  EXPECT_EQ(inside_out.missing, bowl.faces.rows());
  EXPECT_EQ(inside_out.values, Eigen::VectorXd::Zero(bowl.faces.rows()));
}

TEST(ShapeDiameter, FacesWithoutAreaTakeTheirNeighboursValue) {
  Mesh mesh = test::sphere(1, 20);
  const Eigen::VectorXd before = raw(mesh);
  const Faces faces = mesh.faces;
  mesh.faces.resize(faces.rows() + 1, 3);
  mesh.faces << faces, Eigen::RowVector3i(0, 1, 1);
  const ShapeDiameter result = shape_diameter(mesh, {.smoothing = 0});
  EXPECT_EQ(result.missing, 1);
  EXPECT_EQ(result.values.head(faces.rows()), before);
  EXPECT_TRUE(result.values.allFinite());
}

TEST(ShapeDiameter, RefusesWhatItCannotUse) {
  const Mesh mesh = test::sphere(1, 6);
  EXPECT_THROW(shape_diameter(mesh, {.rays = 0}), InputError);
  EXPECT_THROW(shape_diameter(mesh, {.cone_angle = 0}), InputError);
  EXPECT_THROW(shape_diameter(mesh, {.cone_angle = 4}), InputError);
}

TEST(ShapeDiameter, ScalesWithShapesWhoseAreasCannotBeSquared) {
  const Mesh mesh = test::sphere(1, 12);
  const Eigen::VectorXd values = shape_diameter(mesh).values;
  for (const double scale : {0x1p490, 0x1p-490}) {
    const Eigen::VectorXd scaled = shape_diameter({mesh.vertices * scale, mesh.faces}).values;
    for (Eigen::Index f = 0; f < values.size(); ++f) EXPECT_NEAR(scaled[f] / scale, values[f], 1e-12);
  }
}

}  // namespace
}  // namespace partwise
