#include "partwise/geometry/subdivide.h"

#include <gtest/gtest.h>

#include "partwise/base/error.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

Point corner(const Mesh& mesh, int face, int k) { return mesh.vertices.row(mesh.faces(face, k)); }

Point area_vector(const Mesh& mesh, int f) {
  return (corner(mesh, f, 1) - corner(mesh, f, 0)).cross(corner(mesh, f, 2) - corner(mesh, f, 0)) / 2;
}

// What holds for every mesh.
Subdivision checked(const Mesh& mesh, double longest) {
  Subdivision cut = split_long_edges(mesh, longest, 200000);
  EXPECT_EQ(cut.mesh.vertices.topRows(mesh.vertices.rows()), mesh.vertices);
  EXPECT_EQ(cut.parent.size(), static_cast<std::size_t>(cut.mesh.faces.rows()));
  Vertices vectors = Vertices::Zero(mesh.faces.rows(), 3);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.faces.rows());
  for (int f = 0; f < cut.mesh.faces.rows(); ++f) {
    const int parent = cut.parent[f];
    for (int k = 0; k < 3; ++k) EXPECT_LE((corner(cut.mesh, f, k) - corner(cut.mesh, f, (k + 1) % 3)).norm(), longest);
    vectors.row(parent) += area_vector(cut.mesh, f);
    areas[parent] += area_vector(cut.mesh, f).norm();
    // Its corners lie in its parent's plane.
    const Point normal = area_vector(mesh, parent).normalized();
    for (int k = 0; k < 3; ++k) EXPECT_NEAR((corner(cut.mesh, f, k) - corner(mesh, parent, 0)).dot(normal), 0, 1e-12);
  }
  for (int f = 0; f < mesh.faces.rows(); ++f) {
    EXPECT_NEAR((vectors.row(f) - area_vector(mesh, f)).norm(), 0, 1e-12);  // as one piece, the same way round
    EXPECT_NEAR(areas[f], area_vector(mesh, f).norm(), 1e-12);              // without folds
  }
  return cut;
}

TEST(Subdivide, ClosedStaysClosedWithItsVolume) {
  std::mt19937_64 random(1);
  for (double longest : {3.0, 0.7, 0.2, 0.09}) {
    const Mesh mesh = convex_hull(test::cloud(test::Cloud::sphere, 12, random), 1e-9).mesh;
    const Subdivision cut = checked(mesh, longest);
    EXPECT_TRUE(is_watertight(cut.mesh));
    EXPECT_NEAR(signed_volume(cut.mesh), signed_volume(mesh), 1e-12);
    test::expect_closed_sphere(cut.mesh);
  }
}

TEST(Subdivide, OpenAndNonManifoldMeshesAndNeedles) {
  Mesh book{Vertices(7, 3), Faces(5, 3)};  // Three pages at one edge, one of them twice; a needle.
  book.vertices << 0, 0, 0, 0, 0, 1, 1, 0, 0, -1, 0, 0, 0, 1, 0, 5, 0, 0, 0, 1e-7, 0;
  book.faces << 0, 1, 2, 0, 1, 3, 1, 0, 4, 0, 1, 4, 0, 5, 6;
  const Subdivision cut = checked(book, 0.11);
  EXPECT_EQ(cut.parent.front(), 0);
  EXPECT_TRUE(std::ranges::is_sorted(cut.parent));
}

TEST(Subdivide, ShortEdgesStayAsTheyAre) {
  const Mesh mesh = test::box(Point(0, 0, 0), Point(1, 1, 1));
  const Subdivision cut = split_long_edges(mesh, 2, 12);
  EXPECT_EQ(cut.mesh.vertices, mesh.vertices);
  EXPECT_EQ(cut.mesh.faces, mesh.faces);
}

TEST(Subdivide, FacesWithoutAreaEndToo) {
  Mesh mesh{Vertices(3, 3), Faces(3, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 2, 0, 0;
  mesh.faces << 0, 1, 2, 0, 2, 0, 1, 1, 1;
  const Subdivision cut = split_long_edges(mesh, 0.1, 10000);
  for (int f = 0; f < cut.mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) EXPECT_LE((corner(cut.mesh, f, k) - corner(cut.mesh, f, (k + 1) % 3)).norm(), 0.1);
}

TEST(Subdivide, TooManyFacesAreRefused) {
  const Mesh mesh = test::box(Point(0, 0, 0), Point(1, 1, 1));
  EXPECT_THROW(split_long_edges(mesh, 1e-4, 10000), InputError);
  EXPECT_THROW(split_long_edges(mesh, 0, 10000), InputError);
}

}  // namespace
}  // namespace partwise
