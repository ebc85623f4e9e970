#include "partwise/parts/applications/net.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/orientation.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

using Eigen::Vector2d;

// The face across each side of each face, and which of its sides that is; -1 on the border.
struct Sides {
  std::vector<std::array<int, 3>> face, side;
};

Sides sides_of(const Mesh& mesh) {
  const std::size_t count = static_cast<std::size_t>(mesh.faces.rows());
  Sides sides{std::vector<std::array<int, 3>>(count, {-1, -1, -1}),
              std::vector<std::array<int, 3>>(count, {-1, -1, -1})};
  for_each_edge(sorted_half_edges(mesh), [&](std::span<const HalfEdge> edge) {
    if (edge.size() > 2 || (edge.size() == 2 && edge[0].forward == edge[1].forward)) {
      throw InputError("mesh",
                       fmt::format("the edge of vertices {} and {} has {} faces{}", edge[0].low, edge[0].high,
                                   edge.size(), edge.size() == 2 ? " that are turned unlike" : ""),
                       "unfold a surface of one side, such as a convex hull");
    }
    if (edge.size() < 2) return;
    for (const auto& [mine, other] : {std::pair(edge[0], edge[1]), std::pair(edge[1], edge[0])}) {
      sides.face[static_cast<std::size_t>(mine.face)][static_cast<std::size_t>(mine.corner)] = other.face;
      sides.side[static_cast<std::size_t>(mine.face)][static_cast<std::size_t>(mine.corner)] = other.corner;
    }
  });
  return sides;
}

// A convex polygon, counter-clockwise.
using Shape = std::span<const Vector2d>;

// Convex polygons have disjoint interiors exactly when a side of one has the other beyond it.
bool beyond_a_side(Shape a, Shape b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vector2d &from = a[i], &to = a[(i + 1) % a.size()];
    if (std::all_of(b.begin(), b.end(), [&](const Vector2d& p) { return orientation(from, to, p) <= 0; })) return true;
  }
  return false;
}

bool overlap(Shape a, Shape b) { return !beyond_a_side(a, b) && !beyond_a_side(b, a); }

class Unfolder {
 public:
  Unfolder(const Mesh& mesh, const UnfoldSettings& settings)
      : mesh_(mesh), settings_(settings), sides_(sides_of(mesh)) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      const Point normal = (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0));
      if (!(normal.norm() > 0)) throw InputError("mesh", fmt::format("face {} has no area", f), "remove such faces");
      normals_.push_back(normal.normalized());
    }
  }

  Unfolding run(const Progress& progress);

 private:
  Point corner(Eigen::Index face, int k) const { return mesh_.vertices.row(mesh_.faces(face, k % 3)); }
  double fold_angle(int face, int side) const;
  std::vector<char> steepest_cuts(const Point& direction) const;
  std::vector<Net> unfold_along(const std::vector<char>& cut) const;
  NetFace first_face(int face) const;
  NetFace hung_face(const Net& net, int parent, int side) const;
  std::vector<Net> without_overlaps(const std::vector<Net>& nets) const;
  void add_cuts(Unfolding& unfolding) const;

  const Mesh& mesh_;
  const UnfoldSettings settings_;
  const Sides sides_;
  std::vector<Point> normals_;
};

double Unfolder::fold_angle(int face, int side) const {
  const int across = sides_.face[static_cast<std::size_t>(face)][static_cast<std::size_t>(side)];
  const Point &n = normals_[static_cast<std::size_t>(face)], &m = normals_[static_cast<std::size_t>(across)];
  const Point along = (corner(face, side + 1) - corner(face, side)).normalized();
  return std::atan2(n.cross(m).dot(along), n.dot(m));
}

// Of each face and side whether it is cut: from every vertex, the edge that rises most along the direction. Vertices
// from which none rises are tops. Faces then hang together where no cut is between them; on a sphere the cuts are a
// tree over all vertices, so that the faces are one too.
std::vector<char> Unfolder::steepest_cuts(const Point& direction) const {
  const std::size_t count = static_cast<std::size_t>(mesh_.vertices.rows());
  std::vector<double> steepest(count, 0);
  std::vector<int> toward(count, -1);
  for (Eigen::Index f = 0; f < mesh_.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      for (const auto& [from, to] : {std::pair(k, k + 1), std::pair(k + 1, k)}) {
        const Point edge = corner(f, to) - corner(f, from);
        const double rise = direction.dot(edge) / edge.norm();
        const auto v = static_cast<std::size_t>(mesh_.faces(f, from % 3));
        if (rise > steepest[v]) steepest[v] = rise, toward[v] = mesh_.faces(f, to % 3);
      }
  std::vector<char> cut(static_cast<std::size_t>(3 * mesh_.faces.rows()));
  for (Eigen::Index f = 0; f < mesh_.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh_.faces(f, k), b = mesh_.faces(f, (k + 1) % 3);
      cut[static_cast<std::size_t>(3 * f + k)] =
          toward[static_cast<std::size_t>(a)] == b || toward[static_cast<std::size_t>(b)] == a;
    }
  return cut;
}

NetFace Unfolder::first_face(int face) const {
  const Point along = corner(face, 1) - corner(face, 0), other = corner(face, 2) - corner(face, 0);
  const double length = along.norm();
  NetFace result{.face = face};
  result.corners = {Vector2d(0, 0), Vector2d(length, 0),
                    Vector2d(along.dot(other) / length, along.cross(other).norm() / length)};
  return result;
}

NetFace Unfolder::hung_face(const Net& net, int parent, int side) const {
  const NetFace& from = net.faces[static_cast<std::size_t>(parent)];
  const auto f = static_cast<std::size_t>(from.face);
  const int face = sides_.face[f][static_cast<std::size_t>(side)],
            fold = sides_.side[f][static_cast<std::size_t>(side)];
  const Vector2d start = from.corners[static_cast<std::size_t>(side + 1) % 3],
                 end = from.corners[static_cast<std::size_t>(side)];
  const Point along = corner(face, fold + 1) - corner(face, fold), other = corner(face, fold + 2) - corner(face, fold);
  const double length = along.norm();
  const double x = along.dot(other) / length, y = along.cross(other).norm() / length;
  const Vector2d u = (end - start).normalized(), v(-u.y(), u.x());
  NetFace result{.face = face, .parent = parent, .fold = fold, .angle = fold_angle(from.face, side)};
  result.corners[static_cast<std::size_t>(fold)] = start;
  result.corners[static_cast<std::size_t>(fold + 1) % 3] = end;
  result.corners[static_cast<std::size_t>(fold + 2) % 3] = start + x * u + y * v;
  return result;
}

// Breadth first from the first face that is left, so that a net is as round as the cuts allow.
std::vector<Net> Unfolder::unfold_along(const std::vector<char>& cut) const {
  std::vector<char> placed(static_cast<std::size_t>(mesh_.faces.rows()));
  std::vector<Net> nets;
  for (int seed = 0; seed < mesh_.faces.rows(); ++seed) {
    if (placed[static_cast<std::size_t>(seed)]) continue;
    Net net;
    net.faces.push_back(first_face(seed));
    placed[static_cast<std::size_t>(seed)] = 1;
    for (std::size_t at = 0; at < net.faces.size(); ++at)
      for (int side = 0; side < 3; ++side) {
        const int face = net.faces[at].face;
        const int across = sides_.face[static_cast<std::size_t>(face)][static_cast<std::size_t>(side)];
        if (across < 0 || placed[static_cast<std::size_t>(across)] || cut[static_cast<std::size_t>(3 * face + side)])
          continue;
        placed[static_cast<std::size_t>(across)] = 1;
        net.faces.push_back(hung_face(net, static_cast<int>(at), side));
      }
    nets.push_back(std::move(net));
  }
  return nets;
}

// Faces keep their parents where they overlap nothing that is there; where they do they begin a net.
std::vector<Net> Unfolder::without_overlaps(const std::vector<Net>& nets) const {
  std::vector<Net> result;
  for (const Net& net : nets) {
    std::vector<std::pair<std::size_t, int>> place;  // of each face its net, and its index there
    for (const NetFace& face : net.faces) {
      if (face.parent >= 0) {
        const auto [home, parent] = place[static_cast<std::size_t>(face.parent)];
        const int parent_face = result[home].faces[static_cast<std::size_t>(parent)].face;
        const auto f = static_cast<std::size_t>(face.face);
        NetFace hung = hung_face(result[home], parent, sides_.side[f][static_cast<std::size_t>(face.fold)]);
        PARTWISE_CHECK(parent_face, ==, sides_.face[f][static_cast<std::size_t>(face.fold)]);
        const bool free = std::none_of(result[home].faces.begin(), result[home].faces.end(),
                                       [&](const NetFace& other) { return overlap(other.corners, hung.corners); });
        if (free) {
          place.emplace_back(home, static_cast<int>(result[home].faces.size()));
          result[home].faces.push_back(std::move(hung));
          continue;
        }
      }
      place.emplace_back(result.size(), 0);
      result.emplace_back().faces.push_back(first_face(face.face));
    }
  }
  return result;
}

// A trapezoid outside of the side, as high as there is room for, with flatter ends where the gap beside it is narrow.
// Nothing where a sixth of the height finds none.
std::vector<Vector2d> tab_at(const Vector2d& from, const Vector2d& to, double height,
                             const std::vector<std::vector<Vector2d>>& taken) {
  const Vector2d along = to - from;
  const double length = along.norm();
  const Vector2d u = along / length, outward(u.y(), -u.x());
  for (const double part : {1.0, 0.6, 0.35, 0.17}) {
    const double h = std::min(part * height, 0.4 * length), steep = std::min(h, 0.2 * length);
    for (const auto& [start, end] : {std::pair(steep, steep), std::pair(steep, 0.4 * length),
                                     std::pair(0.4 * length, steep), std::pair(0.4 * length, 0.4 * length)}) {
      const std::vector<Vector2d> tab{to, from, from + start * u + h * outward, to - end * u + h * outward};
      if (std::none_of(taken.begin(), taken.end(), [&](const auto& shape) { return overlap(shape, tab); })) return tab;
    }
  }
  return {};
}

void Unfolder::add_cuts(Unfolding& unfolding) const {
  double mean_edge = 0;
  for (Eigen::Index f = 0; f < mesh_.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) mean_edge += (corner(f, k + 1) - corner(f, k)).norm();
  mean_edge /= static_cast<double>(3 * mesh_.faces.rows());
  const std::size_t count = static_cast<std::size_t>(mesh_.faces.rows());
  std::vector<std::pair<std::size_t, int>> place(count);
  std::vector<std::array<char, 3>> folded(count, {0, 0, 0});
  std::vector<std::vector<std::vector<Vector2d>>> taken(unfolding.nets.size());
  for (std::size_t n = 0; n < unfolding.nets.size(); ++n)
    for (std::size_t i = 0; i < unfolding.nets[n].faces.size(); ++i) {
      const NetFace& face = unfolding.nets[n].faces[i];
      const auto f = static_cast<std::size_t>(face.face);
      place[f] = {n, static_cast<int>(i)};
      taken[n].emplace_back(face.corners.begin(), face.corners.end());
      if (face.parent < 0) continue;
      const auto fold = static_cast<std::size_t>(face.fold);
      folded[f][fold] = 1;
      folded[static_cast<std::size_t>(sides_.face[f][fold])][static_cast<std::size_t>(sides_.side[f][fold])] = 1;
    }
  const auto add = [&](std::size_t f, int side, int number, bool with_tab) {
    const auto [n, i] = place[f];
    const auto& corners = unfolding.nets[n].faces[static_cast<std::size_t>(i)].corners;
    NetEdge edge{.net_face = i, .side = side, .number = number, .tab = {}};
    if (with_tab) {
      edge.tab = tab_at(corners[static_cast<std::size_t>(side)], corners[static_cast<std::size_t>(side + 1) % 3],
                        settings_.tab * mean_edge, taken[n]);
      if (!edge.tab.empty()) taken[n].push_back(edge.tab);
    }
    unfolding.nets[n].cuts.push_back(edge);
    return !unfolding.nets[n].cuts.back().tab.empty();
  };
  for (std::size_t f = 0; f < count; ++f)
    for (int side = 0; side < 3; ++side) {
      if (folded[f][static_cast<std::size_t>(side)]) continue;
      const int across = sides_.face[f][static_cast<std::size_t>(side)];
      if (across < 0) {
        add(f, side, -1, false);
      } else if (static_cast<std::size_t>(across) > f) {
        const int number = ++unfolding.glued;
        const bool here = add(f, side, number, true);
        const bool there =
            add(static_cast<std::size_t>(across), sides_.side[f][static_cast<std::size_t>(side)], number, !here);
        if (!here && !there) ++unfolding.without_tab;
      }
    }
}

Unfolding Unfolder::run(const Progress& progress) {
  std::vector<Net> best;
  std::pair<std::size_t, int> least{SIZE_MAX, 0};
  for (int i = 0; i < settings_.directions && least != std::pair<std::size_t, int>{1, 0}; ++i) {
    progress("unfold", static_cast<double>(i) / settings_.directions);
    // Evenly over the sphere, a Fibonacci lattice; none is along an axis.
    const double z = 1 - (2 * i + 1.0) / settings_.directions,
                 around = std::numbers::pi * (3 - std::sqrt(5.0)) * i + 0.37;
    const double r = std::sqrt(1 - z * z);
    std::vector<Net> nets = unfold_along(steepest_cuts(Point(r * std::cos(around), r * std::sin(around), z)));
    int overlaps = 0;
    for (const Net& net : nets) overlaps += count_overlaps(net);
    if (std::pair(nets.size(), overlaps) < least) least = {nets.size(), overlaps}, best = std::move(nets);
  }
  Unfolding unfolding;
  unfolding.nets = least.second == 0 ? std::move(best) : without_overlaps(best);
  for (const Net& net : unfolding.nets) unfolding.overlaps += count_overlaps(net);
  PARTWISE_CHECK(unfolding.overlaps, ==, 0);
  add_cuts(unfolding);
  return unfolding;
}

}  // namespace

Unfolding unfold(const Mesh& mesh, const UnfoldSettings& settings, const Progress& progress) {
  return Unfolder(mesh, settings).run(progress);
}

int count_overlaps(const Net& net) {
  int overlaps = 0;
  for (std::size_t i = 0; i < net.faces.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) overlaps += overlap(net.faces[i].corners, net.faces[j].corners);
  return overlaps;
}

std::vector<Eigen::Matrix3d> refolded(const Net& net) {
  std::vector<Eigen::Isometry3d> frames;  // of each face, from the plane of the net into space
  std::vector<Eigen::Matrix3d> result;
  for (const NetFace& face : net.faces) {
    Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
    const auto in_plane = [&](std::size_t k) { return Eigen::Vector3d(face.corners[k].x(), face.corners[k].y(), 0); };
    if (face.parent >= 0) {
      const Eigen::Vector3d from = in_plane(static_cast<std::size_t>(face.fold)),
                            to = in_plane(static_cast<std::size_t>(face.fold + 1) % 3);
      // The side runs from `from` to `to` in this face, the other way in the parent, about which the angle is.
      const Eigen::AngleAxisd turn(face.angle, (from - to).normalized());
      frame = frames[static_cast<std::size_t>(face.parent)] * Eigen::Translation3d(from) * turn *
              Eigen::Translation3d(-from);
    }
    frames.push_back(frame);
    Eigen::Matrix3d corners;
    for (std::size_t k = 0; k < 3; ++k) corners.row(static_cast<Eigen::Index>(k)) = (frame * in_plane(k)).transpose();
    result.push_back(corners);
  }
  return result;
}

double refolding_error(const Unfolding& unfolding, const Mesh& mesh) {
  const auto basis = [](const Eigen::Matrix3d& corners) {
    Eigen::Matrix3d axes;
    const Point along = corners.row(1) - corners.row(0), other = corners.row(2) - corners.row(0);
    axes.row(0) = along.normalized();
    axes.row(2) = along.cross(other).normalized();
    axes.row(1) = Point(axes.row(2)).cross(Point(axes.row(0)));
    return axes;
  };
  const auto in_mesh = [&](const NetFace& face) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.row(k) = mesh.vertices.row(mesh.faces(face.face, k));
    return corners;
  };
  double error = 0;
  for (const Net& net : unfolding.nets) {
    const std::vector<Eigen::Matrix3d> folded = refolded(net);
    const Eigen::Matrix3d target = in_mesh(net.faces[0]);
    const Eigen::Matrix3d turn = basis(folded[0]).transpose() * basis(target);  // of row vectors
    const Point from = folded[0].row(0), to = target.row(0);
    for (std::size_t i = 0; i < folded.size(); ++i) {
      const Eigen::Matrix3d moved = (((folded[i].rowwise() - from) * turn).rowwise() + to);
      error = std::max(error, (moved - in_mesh(net.faces[i])).rowwise().norm().maxCoeff());
    }
  }
  return error / bounding_sphere(mesh).radius;
}

}  // namespace partwise
