#include "partwise/geometry/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// A torus of the radii 1 and `tube`, `rings` times `sides` vertices.
Mesh torus(int rings, int sides, double tube) {
  Mesh mesh{Vertices(rings * sides, 3), Faces(2 * rings * sides, 3)};
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double a = 2 * std::numbers::pi * i / rings, b = 2 * std::numbers::pi * j / sides;
      const double radius = 1 + tube * std::cos(b);
      mesh.vertices.row(i * sides + j) << radius * std::cos(a), radius * std::sin(a), tube * std::sin(b);
      const int here = i * sides + j, along = (i + 1) % rings * sides + j;
      const int up = i * sides + (j + 1) % sides, across = (i + 1) % rings * sides + (j + 1) % sides;
      mesh.faces.row(2 * here) << here, along, across;
      mesh.faces.row(2 * here + 1) << here, across, up;
    }
  }
  return mesh;
}

double distance_to_torus(const Point& p, double tube) {
  return std::abs(std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - tube);
}

double mean_distance(const Mesh& mesh, double tube) {
  double sum = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) sum += distance_to_torus(mesh.vertices.row(v), tube);
  return sum / static_cast<double>(mesh.vertices.rows());
}

// A flat square of n x n squares, in the plane z = 0.
Mesh square(int n) {
  Mesh mesh{Vertices((n + 1) * (n + 1), 3), Faces(2 * n * n, 3)};
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.vertices.row(i * (n + 1) + j) << i, j, 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int here = i * (n + 1) + j;
      mesh.faces.row(2 * (i * n + j)) << here, here + n + 1, here + n + 2;
      mesh.faces.row(2 * (i * n + j) + 1) << here, here + n + 2, here + 1;
    }
  }
  return mesh;
}

TEST(Smoothing, TakesNoiseAwayAndKeepsTheShape) {
  constexpr double tube = 0.3, noise = 0.02;
  const Mesh clean = torus(120, 36, tube);
  Mesh noisy = clean;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-noise, noise);
  for (double& each : noisy.vertices.reshaped()) each += step(random);
  const double before = mean_distance(noisy, tube), after = mean_distance(smoothed(noisy, 10), tube);
  EXPECT_GT(before, 0.4 * noise);
  EXPECT_LT(after, before / 2.5);
  EXPECT_LT(mean_distance(smoothed(clean, 10), tube), 0.01 * tube);  // does not shrink: a mere mean would
}

TEST(Smoothing, FlatMeshesAndTheirRimsStay) {
  const Mesh flat = square(30), smooth = smoothed(flat, 5);
  EXPECT_LT(smooth.vertices.col(2).cwiseAbs().maxCoeff(), 1e-15);
  // Corners are rounded; ten steps away, farther than five rounds reach, the rim stays.
  for (int i = 11; i <= 19; ++i)
    EXPECT_LT((smooth.vertices.row(i * 31) - flat.vertices.row(i * 31)).norm(), 1e-12) << i;
  EXPECT_EQ(smoothed(flat, 0).vertices, flat.vertices);
}

TEST(Smoothing, TheRimFollowsTheRimAlone) {
  Mesh bent = square(8), other = bent;
  other.vertices(4 * 9 + 4, 2) = 3;  // a spike in the middle
  const Mesh a = smoothed(bent, 3), b = smoothed(other, 3);
  for (int i = 0; i <= 8; ++i) {
    for (const int v : {i * 9, i * 9 + 8, i, 8 * 9 + i}) EXPECT_EQ(a.vertices.row(v), b.vertices.row(v));
  }
  EXPECT_LT(b.vertices(4 * 9 + 4, 2), 1.5);
}

TEST(Smoothing, WhatLiesAtOnePlaceMovesTogether) {
  const Mesh whole = torus(24, 12, 0.3);
  Mesh soup{Vertices(3 * whole.faces.rows(), 3), whole.faces};
  for (int f = 0; f < whole.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      soup.vertices.row(3 * f + k) = whole.vertices.row(whole.faces(f, k));
      soup.faces(f, k) = 3 * f + k;
    }
  }
  const Mesh a = smoothed(whole, 5), b = smoothed(soup, 5);
  for (int f = 0; f < whole.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT((a.vertices.row(a.faces(f, k)) - b.vertices.row(b.faces(f, k))).norm(), 1e-14);
}

TEST(Smoothing, VerticesWithoutAFaceAndDegenerateFacesStay) {
  Mesh mesh{Vertices(4, 3), Faces(1, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5;
  mesh.faces << 1, 1, 2;
  EXPECT_EQ(smoothed(mesh, 3).vertices, mesh.vertices);
  EXPECT_THROW(smoothed(mesh, -1), CheckFailed);
}

}  // namespace
}  // namespace partwise
