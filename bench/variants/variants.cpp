#include "bench/variants/variants.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "partwise/geometry/inner_visibility.h"
#include "partwise/geometry/subdivide.h"

namespace partwise::bench {
namespace {

constexpr double kRippleHeight = 0.002, kRippleLength = 0.2;  // R

// Even in [-1, 1).
double even(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-52 - 1; }

}  // namespace

Mesh noisy(Mesh mesh, double amplitude, int seed, bool along_normals) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  const Vertices normal = along_normals ? vertex_normals(mesh) : Vertices();
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    Point step;
    if (along_normals) {
      step = even(random) * normal.row(v);
    } else {
      do {
        for (int k = 0; k < 3; ++k) step[k] = even(random);
      } while (step.squaredNorm() > 1);
    }
    mesh.vertices.row(v) += amplitude * step;
  }
  return mesh;
}

Mesh finer(const Mesh& mesh, int vertices) {
  const int most_faces = 8 * vertices;
  const std::vector<double> areas = face_areas(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  // Equal triangles of so many vertices would have edges of about this length.
  const double guess = std::sqrt(area / vertices);
  double low = guess / 2, high = 8 * guess;
  Mesh best = mesh;
  const auto miss = [&](const Mesh& candidate) { return std::abs(candidate.vertices.rows() - vertices); };
  for (int round = 0; round < 24 && miss(best) > vertices / 100; ++round) {
    const double longest = std::sqrt(low * high);
    Mesh candidate = split_long_edges(mesh, longest, most_faces).mesh;
    (candidate.vertices.rows() > vertices ? low : high) = longest;
    if (miss(candidate) < miss(best)) best = std::move(candidate);
  }
  return best;
}

Mesh rippled(Mesh mesh) {
  const Sphere sphere = bounding_sphere(mesh);
  const Vertices normal = vertex_normals(mesh);
  const double turn = 2 * std::numbers::pi / kRippleLength;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Point at = turn * (mesh.vertices.row(v) - sphere.centre) / sphere.radius;
    const double wave = std::sin(at[0]) * std::sin(at[1]) * std::sin(at[2]);
    mesh.vertices.row(v) += kRippleHeight * sphere.radius * wave * normal.row(v);
  }
  return mesh;
}

}  // namespace partwise::bench
