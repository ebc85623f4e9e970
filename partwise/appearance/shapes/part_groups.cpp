#include "partwise/appearance/shapes/part_groups.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "partwise/base/error.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/geometry/principal_axes.h"

namespace partwise {
namespace {

constexpr double kAlike = 0.1;       // of the larger of two measures
constexpr std::size_t kAsked = 200;  // corners of a group whose distance to others is measured

using Position = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Tree = boost::geometry::index::rtree<Position, boost::geometry::index::rstar<16>>;

Position position(const Mesh& mesh, int vertex) {
  return {mesh.vertices(vertex, 0), mesh.vertices(vertex, 1), mesh.vertices(vertex, 2)};
}

// Renumbered 0 .. by first face.
std::vector<int> numbered(std::span<const int> labels, int& count) {
  std::map<int, int> number;
  std::vector<int> result;
  for (const int label : labels) result.push_back(number.emplace(label, static_cast<int>(number.size())).first->second);
  count = static_cast<int>(number.size());
  return result;
}

// The faces of each label.
std::vector<std::vector<int>> members(const std::vector<int>& labels, int count) {
  std::vector<std::vector<int>> faces(static_cast<std::size_t>(count));
  for (std::size_t f = 0; f < labels.size(); ++f) faces[labels[f]].push_back(static_cast<int>(f));
  return faces;
}

// Square root of the area, and the roots of the principal second moments of area over the area, from large to small:
// unlike extents along the principal axes these do not jump where two axes are alike.
using Looks = std::array<double, 4>;

Looks looks(const Mesh& mesh, const std::vector<int>& faces) {
  const SurfaceMoments moments = surface_moments({mesh.vertices, mesh.faces(faces, Eigen::all)});
  const Eigen::Vector3d principal =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments.second).eigenvalues().cwiseMax(0).cwiseSqrt();
  return {std::sqrt(moments.area), principal[2], principal[1], principal[0]};
}

// Thin directions are compared on the scale of the part, or a sheet would never be like another.
bool alike(const Looks& a, const Looks& b) {
  const double scale = std::max(a[1], b[1]);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double larger = std::max(a[i], b[i]);
    if (std::abs(a[i] - b[i]) > kAlike * std::max(larger, kAlike * scale)) return false;
  }
  return true;
}

std::vector<int> corners(const Mesh& mesh, const std::vector<int>& faces) {
  std::vector<int> vertices;
  for (const int f : faces)
    for (const int v : mesh.faces.row(f)) vertices.push_back(v);
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Tree tree_of(const Mesh& mesh, const std::vector<int>& vertices) {
  std::vector<Position> positions;
  positions.reserve(vertices.size());
  for (const int v : vertices) positions.push_back(position(mesh, v));
  return Tree(positions);
}

double mean_distance(const Mesh& mesh, const std::vector<int>& from, const Tree& to) {
  double sum = 0;
  const std::size_t step = std::max<std::size_t>(1, from.size() / kAsked);
  std::size_t asked = 0;
  for (std::size_t i = 0; i < from.size(); i += step, ++asked) {
    const Position p = position(mesh, from[i]);
    const auto nearest = to.qbegin(boost::geometry::index::nearest(p, 1));
    sum += boost::geometry::distance(p, *nearest);
  }
  return sum / static_cast<double>(asked);
}

// One more join: the smallest group into the closest.
void join_smallest(const Mesh& mesh, std::vector<int>& labels, int& count) {
  const std::vector<double> areas = face_areas(mesh);
  std::vector<double> area(static_cast<std::size_t>(count), 0.0);
  for (std::size_t f = 0; f < labels.size(); ++f) area[labels[f]] += areas[f];
  const int small = static_cast<int>(std::ranges::min_element(area) - area.begin());
  const std::vector<std::vector<int>> faces = members(labels, count);
  const std::vector<int> from = corners(mesh, faces[small]);
  int closest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int group = 0; group < count; ++group) {
    if (group == small) continue;
    const double distance = mean_distance(mesh, from, tree_of(mesh, corners(mesh, faces[group])));
    if (distance < least) least = distance, closest = group;
  }
  for (int& label : labels)
    if (label == small) label = closest;
  labels = numbered(labels, count);
}

}  // namespace

PartGroups group_parts(const Mesh& mesh, std::span<const int> part_of_face, int target) {
  if (static_cast<Eigen::Index>(part_of_face.size()) != mesh.faces.rows()) {
    throw InputError("part labels", fmt::format("{} for {} faces", part_of_face.size(), mesh.faces.rows()),
                     "give one a face");
  }
  if (target < 1) throw InputError("number of parts", fmt::format("{} is out of range", target), "give 1 or more");
  PartGroups groups;
  int parts = 0;
  groups.of_face = numbered(part_of_face, parts);
  std::vector<Looks> seen;
  for (const std::vector<int>& faces : members(groups.of_face, parts)) seen.push_back(looks(mesh, faces));
  DisjointSets same(static_cast<std::size_t>(parts));
  for (int a = 0; a < parts; ++a)
    for (int b = 0; b < a; ++b)
      if (alike(seen[a], seen[b])) same.join(a, b);
  for (int& label : groups.of_face) label = same.find(label);
  groups.of_face = numbered(groups.of_face, groups.count);
  while (groups.count > target) join_smallest(mesh, groups.of_face, groups.count);
  return groups;
}

}  // namespace partwise
