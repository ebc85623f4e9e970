#include "partwise/geometry/union_volume.h"

#include <tbb/global_control.h>

#include <numbers>

#include "partwise/base/error.h"
#include "partwise/geometry/test_shapes.h"

namespace partwise {
namespace {

using test::box;

double relative_error(double found, double expected) { return std::abs(found / expected - 1); }

Mesh oriented_box(std::mt19937_64& random) {
  std::uniform_real_distribution<double> side(0.3, 1), place(-0.5, 0.5);
  Vertices corners = test::box_corners(-Point(side(random), side(random), side(random)),
                                       Point(side(random), side(random), side(random)));
  corners = (corners * test::random_rotation(random)).eval();
  return convex_hull(corners.rowwise() + Point(place(random), place(random), place(random)), 1e-9).mesh;
}

// The volume of the common part of convex meshes: the hull of all corners of planes that lie in all of them.
double common_volume(std::span<const Mesh> meshes) {
  std::vector<Eigen::Vector4d> planes;
  for (const Mesh& mesh : meshes) {
    const auto own = hull_planes(mesh);
    for (const auto& plane : own.rowwise()) planes.push_back(plane.transpose());
  }
  std::vector<Point> corners;
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix3d rows;
        rows << planes[i].head<3>().transpose(), planes[j].head<3>().transpose(), planes[k].head<3>().transpose();
        if (std::abs(rows.determinant()) < 1e-9) continue;
        const Eigen::Vector3d x = rows.inverse() * Eigen::Vector3d(planes[i][3], planes[j][3], planes[k][3]);
        bool inside = true;
        for (const auto& plane : planes) inside = inside && plane.head<3>().dot(x) <= plane[3] + 1e-12;
        if (inside) corners.push_back(x.transpose());
      }
  if (corners.size() < 4) return 0;
  Vertices points(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = corners[i];
  const ConvexHull hull = convex_hull(points, 1e-9);
  return hull.thickened ? 0 : hull.volume;
}

// Every point of a regular grid of 2 x `lines` meridians and parallels, a closed mesh.
Mesh ball(int lines, double radius) {
  Mesh mesh{Vertices(2 * lines * (lines - 1) + 2, 3), Faces(4 * lines * (lines - 1), 3)};
  const int ring = 2 * lines, top = static_cast<int>(mesh.vertices.rows()) - 2, bottom = top + 1;
  for (int i = 0; i < lines - 1; ++i)
    for (int j = 0; j < ring; ++j) {
      const double polar = std::numbers::pi * (i + 1) / lines, azimuth = std::numbers::pi * j / lines;
      mesh.vertices.row(i * ring + j) << std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar);
    }
  mesh.vertices.row(top) << 0, 0, 1;
  mesh.vertices.row(bottom) << 0, 0, -1;
  mesh.vertices *= radius;
  Eigen::Index row = 0;
  for (int j = 0; j < ring; ++j) {
    const int k = (j + 1) % ring;
    mesh.faces.row(row++) << top, j, k;
    mesh.faces.row(row++) << bottom, (lines - 2) * ring + k, (lines - 2) * ring + j;
    for (int i = 0; i + 1 < lines - 1; ++i) {
      mesh.faces.row(row++) << i * ring + j, (i + 1) * ring + j, (i + 1) * ring + k;
      mesh.faces.row(row++) << i * ring + j, (i + 1) * ring + k, i * ring + k;
    }
  }
  return mesh;
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh both{Vertices(a.vertices.rows() + b.vertices.rows(), 3), Faces(a.faces.rows() + b.faces.rows(), 3)};
  both.vertices << a.vertices, b.vertices;
  both.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
  return both;
}

TEST(UnionVolume, BoxesOverlappingNestedDisjointTouching) {
  const Mesh a = box({0, 0, 0}, {1, 2, 3});
  const auto united = [&](const Mesh& b) { return union_volume(std::vector{a, b}); };
  EXPECT_LT(relative_error(union_volume(std::vector{a}), 6), 2e-4);
  EXPECT_LT(relative_error(united(box({0.5, 0.5, 0.5}, {1.5, 1.5, 4})), 6 + 3.5 - 1.25), 2e-4);
  EXPECT_LT(relative_error(united(box({0.2, 0.3, 0.4}, {0.5, 0.6, 0.7})), 6), 2e-4);
  EXPECT_LT(relative_error(united(box({3, 0, 0}, {4, 1, 1})), 7), 2e-4);
  EXPECT_LT(relative_error(united(box({1, 0, 0}, {2, 2, 3})), 12), 2e-4);
  EXPECT_LT(relative_error(united(a), 6), 2e-4);
  EXPECT_EQ(union_volume({}), 0);
}

TEST(UnionVolume, RotatedBoxes) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const Mesh one = oriented_box(random);
    EXPECT_LT(relative_error(union_volume(std::vector{one}), signed_volume(one)), 1e-4);
  }
}

TEST(UnionVolume, ThreeRotatedBoxesByInclusionAndExclusion) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 30; ++trial) {
    const std::vector<Mesh> m{oriented_box(random), oriented_box(random), oriented_box(random)};
    const double expected = signed_volume(m[0]) + signed_volume(m[1]) + signed_volume(m[2]) -
                            common_volume(std::vector{m[0], m[1]}) - common_volume(std::vector{m[0], m[2]}) -
                            common_volume(std::vector{m[1], m[2]}) + common_volume(m);
    EXPECT_LT(relative_error(union_volume(m), expected), 1e-4) << trial;
  }
}

TEST(UnionVolume, ConvergesFasterThanTheSpacing) {
  std::mt19937_64 random(3);
  double coarse = 0, fine = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Mesh one = oriented_box(random);
    coarse += relative_error(union_volume(std::vector{one}, {.lines = 16}), signed_volume(one));
    fine += relative_error(union_volume(std::vector{one}, {.lines = 256}), signed_volume(one));
  }
  EXPECT_LT(fine, coarse / 32);  // Linear convergence would give 16.
}

TEST(UnionVolume, CoverageOfABallByItsCore) {
  const Mesh solid = ball(60, 1), core = box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const Coverage found = coverage(solid, std::vector{core});
  EXPECT_LT(relative_error(found.solid_volume, signed_volume(solid)), 1e-4);
  EXPECT_LT(relative_error(found.union_volume, 1), 2e-4);
  EXPECT_NEAR(found.uncovered, found.solid_volume - found.union_volume, 1e-12);  // on the same lines
  const Coverage all = coverage(core, std::vector{convex_hull(solid.vertices, 1e-9).mesh});
  EXPECT_EQ(all.uncovered, 0);
}

TEST(UnionVolume, WindingNumbersOfCavitiesAndOverlaps) {
  const Mesh outer = box({0, 0, 0}, {3, 3, 3}), inner = box({1, 1, 1}, {2, 2, 2});
  Mesh cavity = inner;
  cavity.faces.col(0).swap(cavity.faces.col(1));
  EXPECT_LT(relative_error(coverage(joined(outer, cavity), {}).solid_volume, 26), 2e-4);
  EXPECT_LT(relative_error(coverage(joined(outer, inner), {}).solid_volume, 27), 2e-4);
  EXPECT_NEAR(coverage(joined(outer, cavity), std::vector{inner}).uncovered, 26, 26 * 2e-4);
  EXPECT_EQ(coverage(joined(outer, cavity), std::vector{outer}).uncovered, 0);
}

// Each face is cut into four by the middles of its sides, `times` times over.
Mesh subdivided(Mesh mesh, int times) {
  for (; times > 0; --times) {
    Mesh fine{mesh.vertices, Faces(4 * mesh.faces.rows(), 3)};
    fine.vertices.conservativeResize(mesh.vertices.rows() + mesh.faces.size(), 3);
    int middle = static_cast<int>(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f, middle += 3) {
      const Eigen::RowVector3i c = mesh.faces.row(f);
      for (int k = 0; k < 3; ++k) {
        fine.vertices.row(middle + k) = (mesh.vertices.row(c[k]) + mesh.vertices.row(c[(k + 1) % 3])) / 2;
        fine.faces.row(4 * f + k) << c[k], middle + k, middle + (k + 2) % 3;
      }
      fine.faces.row(4 * f + 3) << middle, middle + 1, middle + 2;
    }
    mesh = std::move(fine);
  }
  return mesh;
}

// The same solid with 12 and with 49,152 faces on the same lines: one line counted wrongly at an edge or a vertex would
// cost some 1e-5 of the volume.
TEST(UnionVolume, NoLineIsLostAtEdgesAndVertices) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 5; ++trial) {
    const Mesh coarse = oriented_box(random), fine = subdivided(coarse, 6);
    for (int lines : {16, 256}) {
      const double expected = coverage(coarse, {}, {.lines = lines}).solid_volume;
      EXPECT_LT(relative_error(coverage(fine, {}, {.lines = lines}).solid_volume, expected), 1e-12);
      EXPECT_LT(relative_error(union_volume(std::vector{fine}, {.lines = lines}), expected), 1e-12);
    }
  }
}

TEST(UnionVolume, EveryAxisAndScale) {
  for (int axis = 0; axis < 3; ++axis)
    for (double scale : {1e-9, 1.0, 1e9}) {
      Point high(1, 1, 1);
      high[axis] = 5;
      Mesh one = box({0, 0, 0}, high);
      one.vertices = (scale * (one.vertices.rowwise() + Point(100, 100, 100))).eval();
      EXPECT_LT(relative_error(union_volume(std::vector{one}), 5 * std::pow(scale, 3)), 2e-4);
    }
}

TEST(UnionVolume, SameBytesForAnyNumberOfThreads) {
  std::mt19937_64 random(4);
  const std::vector<Mesh> meshes{oriented_box(random), oriented_box(random), oriented_box(random)};
  const double many = union_volume(meshes);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(union_volume(meshes), many);
}

TEST(UnionVolume, NoLinesAreAnInputError) { EXPECT_THROW(union_volume({}, {.lines = 0}), InputError); }

}  // namespace
}  // namespace partwise
