#include "partwise/parts/solid/plane_split.h"

#include <tbb/parallel_for.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/solid/hull_part.h"
#include "partwise/parts/solid/part_graph.h"

namespace partwise {
namespace {

struct Centroids {
  Vertices at;
  Eigen::VectorXd area;
};

Centroids centroids(const Mesh& mesh, const std::vector<int>& faces) {
  Centroids c{Vertices(static_cast<Eigen::Index>(faces.size()), 3),
              Eigen::VectorXd(static_cast<Eigen::Index>(faces.size()))};
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Point p = mesh.vertices.row(mesh.faces(faces[i], 0)), q = mesh.vertices.row(mesh.faces(faces[i], 1)),
                r = mesh.vertices.row(mesh.faces(faces[i], 2));
    c.at.row(static_cast<Eigen::Index>(i)) = (p + q + r) / 3;
    c.area[static_cast<Eigen::Index>(i)] = (q - p).cross(r - p).norm() / 2;
  }
  return c;
}

Point middle(const Centroids& c) {
  return (c.at.array().colwise() * c.area.array()).colwise().sum() / std::max(c.area.sum(), 1e-300);
}

// By columns, the longest last.
Eigen::Matrix3d principal_axes(const Centroids& c) {
  const Vertices centred = c.at.rowwise() - middle(c);
  const Eigen::Matrix3d covariance = centred.transpose() * (centred.array().colwise() * c.area.array()).matrix();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
}

// The principal axes of the surface, the directions half-way between two of them, and those between all three.
std::array<Eigen::Vector3d, 13> plane_normals(const Centroids& c) {
  const Eigen::Matrix3d axes = principal_axes(c);
  std::array<Eigen::Vector3d, 13> normals;
  std::size_t n = 0;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3i mix(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (i > 13) normals[n++] = (axes * mix.cast<double>()).normalized();  // One of each pair of opposites.
  }
  return normals;
}

std::vector<std::vector<int>> connected_pieces(const Mesh& mesh, const std::array<std::vector<int>, 2>& sides) {
  std::vector<std::vector<int>> pieces = connected_groups(mesh, sides[0]);
  for (auto& group : connected_groups(mesh, sides[1])) pieces.push_back(std::move(group));
  return pieces;
}

}  // namespace

std::vector<std::vector<int>> split_by_plane(const Mesh& mesh, const std::vector<int>& faces, const Point& through,
                                             double minimum_thickness) {
  const Centroids c = centroids(mesh, faces);
  const auto normals = plane_normals(c);
  struct Trial {
    double volume = std::numeric_limits<double>::infinity();
    std::array<std::vector<int>, 2> side;
  };
  std::array<Trial, 13> trials;
  tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t t) {
    const Eigen::VectorXd height = (c.at.rowwise() - through) * normals[t];
    auto& side = trials[t].side;
    for (std::size_t i = 0; i < faces.size(); ++i) side[height[static_cast<Eigen::Index>(i)] > 0].push_back(faces[i]);
    if (side[0].empty() || side[1].empty()) return;
    trials[t].volume = 0;
    for (const auto& half : side)
      trials[t].volume += convex_hull(extreme_points(corners_of(mesh, half)), minimum_thickness).volume;
  });
  const Trial& best = *std::min_element(trials.begin(), trials.end(),
                                        [](const Trial& a, const Trial& b) { return a.volume < b.volume; });
  if (best.volume == std::numeric_limits<double>::infinity()) {
    // The tip of a simplified hull can lie so far out that no plane through it meets the part: then through its middle.
    const Point mean = c.at.colwise().mean();
    if (through != mean) return split_by_plane(mesh, faces, mean, minimum_thickness);
    std::vector<std::vector<int>> single;  // Faces that no plane can tell apart.
    single.reserve(faces.size());
    for (int f : faces) single.push_back({f});
    return single;
  }
  return connected_pieces(mesh, best.side);
}

std::vector<std::vector<int>> halve(const Mesh& mesh, const std::vector<int>& faces) {
  const Centroids c = centroids(mesh, faces);
  const Eigen::VectorXd height = (c.at.rowwise() - middle(c)) * principal_axes(c).col(2);
  std::array<std::vector<int>, 2> side;
  for (std::size_t i = 0; i < faces.size(); ++i) side[height[static_cast<Eigen::Index>(i)] > 0].push_back(faces[i]);
  return connected_pieces(mesh, side);
}

}  // namespace partwise
