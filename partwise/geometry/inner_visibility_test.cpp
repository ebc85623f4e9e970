#include "partwise/geometry/inner_visibility.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/base/error.h"
#include "partwise/geometry/subdivide.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// A torus, its tube thick enough that some of it sees across.
Mesh torus(int around, int along) {
  Mesh mesh{Vertices(around * along, 3), Faces(2 * around * along, 3)};
  for (int i = 0; i < along; ++i)
    for (int k = 0; k < around; ++k) {
      const double u = 2 * std::numbers::pi * i / along, v = 2 * std::numbers::pi * k / around;
      mesh.vertices.row(i * around + k) << (2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u),
          std::sin(v);
      const int a = i * around + k, b = i * around + (k + 1) % around;
      const int c = (i + 1) % along * around + k, d = (i + 1) % along * around + (k + 1) % around;
      mesh.faces.row(2 * a) << a, c, d;
      mesh.faces.row(2 * a + 1) << a, d, b;
    }
  return mesh;
}

Mesh two_boxes() {
  const Mesh a = split_long_edges(test::box({0, 0, 0}, {2, 1, 1}), 0.5, 10000).mesh;
  const Mesh b = split_long_edges(test::box({1.5, -0.25, 0.25}, {2.5, 0.75, 0.75}), 0.5, 10000).mesh;
  Mesh both{Vertices(a.vertices.rows() + b.vertices.rows(), 3), Faces(a.faces.rows() + b.faces.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
  return both;
}

// Every pair of vertices against exact predicates on the very coordinates that the rays have. Only segments that pass
// an edge of a face within the stated distance may be decided otherwise.
TEST(InnerVisibility, AgreesWithExactPredicatesButForGrazingSegments) {
  constexpr double kGrazing = 2e-6;
  for (const Mesh& mesh : {torus(14, 24), two_boxes()}) {
    const InnerVisibility visibility(mesh);
    const Sphere sphere = bounding_sphere(mesh);
    const auto point = [](const auto& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
    std::vector<Kernel::Triangle_3> triangles;
    for (const auto& f : mesh.faces.rowwise()) {
      const auto corner = [&](int k) {
        const Point scaled = (mesh.vertices.row(f[k]) - sphere.centre) / sphere.radius;
        return point(Point(scaled.cast<float>().cast<double>()));
      };
      triangles.emplace_back(corner(0), corner(1), corner(2));
    }
    int seen = 0, hidden = 0;
    for (int p = 0; p < mesh.vertices.rows(); ++p)
      for (int q = 0; q < p; ++q) {
        const Kernel::Segment_3 segment(point(Point(visibility.inner_points().row(p).cast<double>())),
                                        point(Point(visibility.inner_points().row(q).cast<double>())));
        const bool blocked = std::any_of(triangles.begin(), triangles.end(),
                                         [&](const auto& triangle) { return CGAL::do_intersect(segment, triangle); });
        ++(blocked ? hidden : seen);
        EXPECT_EQ(visibility.sees(p, q), visibility.sees(q, p));
        if (visibility.sees(p, q) != blocked) continue;
        double nearest = 1;
        for (const auto& t : triangles)
          for (int k = 0; k < 3; ++k)
            nearest =
                std::min(nearest, CGAL::to_double(CGAL::squared_distance(segment, Kernel::Segment_3(t[k], t[k + 1]))));
        EXPECT_LT(std::sqrt(nearest), kGrazing) << p << " " << q;
      }
    EXPECT_GT(seen, 1000);
    EXPECT_GT(hidden, 1000);
  }
}

TEST(InnerVisibility, OfAConvexSolidIsAllWithFacesInOnePlane) {
  const Mesh mesh = split_long_edges(test::box({0, 0, 0}, {3, 2, 1}), 0.6, 10000).mesh;
  const InnerVisibility visibility(mesh);
  for (int p = 0; p < mesh.vertices.rows(); ++p)
    for (int q = 0; q < p; ++q) EXPECT_TRUE(visibility.sees(p, q)) << p << " " << q;
}

TEST(InnerVisibility, FindsTheOtherSideOfTheWall) {
  const Mesh mesh = split_long_edges(test::box({0, 0, 0}, {4, 4, 0.1}), 0.5, 10000).mesh;
  const InnerVisibility visibility(mesh);
  int asked = 0;
  for (int v = 0; v < mesh.vertices.rows(); ++v) {
    const Point p = mesh.vertices.row(v);
    if (p.head<2>().minCoeff() < 0.2 || p.head<2>().maxCoeff() > 3.8) continue;
    const int face = visibility.opposite_face(v);
    ASSERT_GE(face, 0);
    for (const int corner : mesh.faces.row(face)) EXPECT_NEAR(mesh.vertices(corner, 2), 0.1 - p[2], 1e-12);
    ++asked;
  }
  EXPECT_GT(asked, 20);
}

TEST(InnerVisibility, RefusesAMeshWithoutArea) {
  EXPECT_THROW(InnerVisibility({Vertices::Zero(3, 3), (Faces(1, 3) << 0, 1, 2).finished()}), InputError);
}

}  // namespace
}  // namespace partwise
