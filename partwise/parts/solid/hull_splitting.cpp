#include "partwise/parts/solid/hull_splitting.h"

#include <tbb/parallel_for.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace partwise {
namespace {

// A separation of ridges is worth it when no piece reaches outside by more than this share of what the whole did.
constexpr double kReachLeft = 0.8;

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

// The principal axes of the surface, the directions half-way between two of them, and those between all three.
std::array<Eigen::Vector3d, 13> plane_normals(const Centroids& c) {
  const Point mean = (c.at.array().colwise() * c.area.array()).colwise().sum() / std::max(c.area.sum(), 1e-300);
  const Vertices centred = c.at.rowwise() - mean;
  const Eigen::Matrix3d covariance = centred.transpose() * (centred.array().colwise() * c.area.array()).matrix();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  std::array<Eigen::Vector3d, 13> normals;
  std::size_t n = 0;
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d mix(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (i > 13) normals[n++] = (axes * mix).normalized();  // One of each pair of opposites.
  }
  return normals;
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
    const Point middle = c.at.colwise().mean();
    return through == middle ? std::vector<std::vector<int>>{faces}
                             : split_by_plane(mesh, faces, middle, minimum_thickness);
  }
  std::vector<std::vector<int>> pieces = connected_groups(mesh, best.side[0]);
  for (auto& group : connected_groups(mesh, best.side[1])) pieces.push_back(std::move(group));
  return pieces;
}

std::vector<HullPart> split_to_tolerance(const Mesh& mesh, const SurfaceQuery& surface, OutsideDistance& outside,
                                         std::vector<int> faces, const SplittingSettings& settings,
                                         const Progress& progress) {
  struct Open {
    HullPart part;
    bool try_ridges;  // no separation has failed on what this was cut from
  };
  const auto body_of = [&](const HullPart& part) {
    return ConvexBody(convex_hull(part.corners, settings.minimum_thickness).mesh);
  };
  const auto parts_of = [&](std::vector<std::vector<int>> groups) {
    std::vector<HullPart> pieces;
    for (auto& group : groups) pieces.push_back(hull_part(mesh, std::move(group), settings.minimum_thickness));
    return pieces;
  };
  const double total = static_cast<double>(faces.size());
  double finished = 0;
  std::vector<HullPart> done;
  std::vector<Open> open;
  open.push_back({hull_part(mesh, std::move(faces), settings.minimum_thickness), true});
  while (!open.empty()) {
    progress("splitting", finished / total);
    auto [part, try_ridges] = std::move(open.back());
    open.pop_back();
    const ConvexBody body = body_of(part);
    if (part.faces.size() == 1 || outside.within(body, settings.hull_tolerance)) {
      finished += static_cast<double>(part.faces.size());
      done.push_back(std::move(part));
      continue;
    }
    const OutsideDistance::Reach reach = outside.reach(body, settings.hull_tolerance);
    std::vector<HullPart> pieces;
    if (try_ridges) {
      const double enough = std::max(settings.hull_tolerance, kReachLeft * reach.distance);
      pieces = parts_of(separate_once(mesh, surface, part.faces, settings.valley_tolerance));
      try_ridges = pieces.size() > 1 && std::all_of(pieces.begin(), pieces.end(), [&](const HullPart& piece) {
                     return outside.within(body_of(piece), enough);
                   });
    }
    if (!try_ridges) pieces = parts_of(split_by_plane(mesh, part.faces, reach.where, settings.minimum_thickness));
    if (pieces.size() < 2) {  // Faces that no plane can tell apart: one by one.
      std::vector<std::vector<int>> single;
      for (int f : part.faces) single.push_back({f});
      pieces = parts_of(std::move(single));
    }
    for (HullPart& piece : pieces) open.push_back({std::move(piece), try_ridges});
  }
  return done;
}

}  // namespace partwise
