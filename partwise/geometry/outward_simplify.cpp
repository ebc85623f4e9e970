#include "partwise/geometry/outward_simplify.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

#include "partwise/geometry/half_edge_sphere.h"
#include "partwise/geometry/linear_programme.h"
#include "partwise/geometry/triangle_crossing.h"

namespace partwise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;  // Of the local size: how far inside of a plane still counts as on it.
// The least cosine between the normals of a face before and after. When it stops all, the next is tried.
constexpr double turns[] = {0.3, -0.3};

using Box = std::array<double, 6>;  // low x, y, z, high x, y, z

constexpr std::size_t group = 64;  // consecutive faces, near each other at first, that have a box in common

bool meet(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a[k] > b[k + 3] || b[k] > a[k + 3]) return false;
  return true;
}

class Simplifier {
 public:
  explicit Simplifier(const Mesh& mesh);
  void collapse_to(int max_faces);
  Mesh mesh() const;

 private:
  struct Candidate {
    double cost;
    int half_edge;
    int step;
    bool operator<(const Candidate& other) const {
      return std::tie(other.cost, other.half_edge) < std::tie(cost, half_edge);
    }
  };
  // What the collapse of an edge takes away: the planes of the faces at its ends and the link around them, in units of
  // `size` about `middle`.
  struct Surroundings {
    Point middle = Point::Zero();
    double size = 0;
    std::vector<HalfSpace> planes;
    std::vector<double> areas;        // of the faces, times two
    std::vector<int> link;            // half-edges opposite the two ends in the faces that stay
    std::vector<Point> link_normals;  // of these faces before
  };

  // The faces that a collapse would leave around its vertex.
  struct Fan {
    std::vector<Triangle> triangles;        // the vertex first
    std::vector<std::array<int, 2>> links;  // the other two corners
  };

  Point at(int vertex) const { return position_.row(vertex); }
  void gather(int h);
  double cost_at(const Eigen::Vector3d& x) const;
  bool push_outside(Eigen::Vector3d& x) const;
  double best_place(int h, Point& place);
  void consider(int h);
  bool keeps_valence(int h) const;
  bool fan_crosses(int face, const Fan& fan, const std::array<int, 2>& ends) const;
  bool would_cross(int h, const Point& place) const;
  void set_boxes(int vertex);

  Vertices position_;
  HalfEdgeSphere surface_;
  std::vector<Box> boxes_, group_boxes_;  // of each face, of each group; the latter only grow
  Surroundings around_;
  std::priority_queue<Candidate> candidates_;
  std::vector<int> computed_;  // of each half-edge the step of its latest candidate
  std::vector<int> changed_;   // of each vertex the step of the last change around it
  int step_ = 0, faces_ = 0;
  double turn_ = turns[0];
};

Simplifier::Simplifier(const Mesh& mesh)
    : position_(mesh.vertices),
      surface_(mesh),
      boxes_(static_cast<std::size_t>(mesh.faces.rows())),
      group_boxes_((boxes_.size() + group - 1) / group, {1e300, 1e300, 1e300, -1e300, -1e300, -1e300}),
      computed_(surface_.origin.size(), -1),
      changed_(surface_.out.size(), -1),
      faces_(static_cast<int>(mesh.faces.rows())) {
  for (int v = 0; v < static_cast<int>(surface_.out.size()); ++v)
    if (surface_.out[static_cast<std::size_t>(v)] >= 0) set_boxes(v);
}

void Simplifier::set_boxes(int vertex) {
  const int first = surface_.out[static_cast<std::size_t>(vertex)];
  int h = first;
  do {
    const Point a = at(vertex), b = at(surface_.target(h)), c = at(surface_.origin[surface_.previous(h)]);
    const Point low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
    Box& box = boxes_[static_cast<std::size_t>(h / 3)];
    box = {low[0], low[1], low[2], high[0], high[1], high[2]};
    Box& whole = group_boxes_[static_cast<std::size_t>(h / 3) / group];
    for (std::size_t k = 0; k < 3; ++k) {
      whole[k] = std::min(whole[k], box[k]);
      whole[k + 3] = std::max(whole[k + 3], box[k + 3]);
    }
  } while ((h = surface_.around(h)) != first);
}

void Simplifier::gather(int h) {
  Surroundings& s = around_;
  const int ends[] = {surface_.origin[h], surface_.target(h)};
  s.middle = (at(ends[0]) + at(ends[1])) / 2;
  s.size = 0;
  s.planes.clear();
  s.areas.clear();
  s.link.clear();
  s.link_normals.clear();
  for (const int end : ends) {
    int g = surface_.out[end];
    do s.size = std::max(s.size, (at(surface_.target(g)) - s.middle).norm());
    while ((g = surface_.around(g)) != surface_.out[end]);
  }
  for (const int side : {0, 1}) {
    int g = surface_.out[ends[side]];
    do {
      const int opposite = surface_.next(g);
      const int b = surface_.origin[opposite], c = surface_.target(opposite), other = ends[1 - side];
      const bool goes = b == other || c == other;
      if (goes && side == 1) continue;  // seen from the other end
      const Point normal = (at(b) - at(ends[side])).cross(at(c) - at(ends[side])) / (s.size * s.size);
      const double area = normal.norm();
      const Point unit = area > 0 ? Point(normal / area) : Point::Zero();
      if (!goes) {
        s.link.push_back(opposite);
        s.link_normals.push_back(unit);
      }
      if (area < 1e-12) continue;
      s.planes.push_back({unit.transpose(), unit.dot(at(ends[side]) - s.middle) / s.size});
      s.areas.push_back(area);
    } while ((g = surface_.around(g)) != surface_.out[ends[side]]);
  }
}

// Six times the volume added, and a little for distance from the planes and from the middle, so that flat surroundings
// have one best place.
double Simplifier::cost_at(const Eigen::Vector3d& x) const {
  double cost = 0;
  for (std::size_t f = 0; f < around_.planes.size(); ++f) {
    const double height = around_.planes[f].normal.dot(x) - around_.planes[f].offset;
    if (height < -rounding) return infinity;
    cost += around_.areas[f] * height;
  }
  return cost + 1e-3 * x.squaredNorm();
}

// Along the mean normal until no plane has x inside.
bool Simplifier::push_outside(Eigen::Vector3d& x) const {
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < around_.planes.size(); ++f) direction += around_.areas[f] * around_.planes[f].normal;
  if (!(direction.norm() > 0)) return false;
  direction.normalize();
  double push = 0;
  for (const HalfSpace& plane : around_.planes) {
    const double missing = plane.offset - plane.normal.dot(x), rise = plane.normal.dot(direction);
    if (missing <= 0) continue;
    if (rise < 0.05) return false;
    push = std::max(push, missing / rise);
  }
  x += push * direction;
  return x.norm() < 2;
}

double Simplifier::best_place(int h, Point& place) {
  gather(h);
  if (around_.planes.empty()) return infinity;
  Eigen::Matrix3d squares = 1e-3 * Eigen::Matrix3d::Identity();
  Eigen::Vector3d pull = Eigen::Vector3d::Zero(), volume = Eigen::Vector3d::Zero();
  for (std::size_t f = 0; f < around_.planes.size(); ++f) {
    const auto& [normal, offset] = around_.planes[f];
    squares += around_.areas[f] * normal * normal.transpose();
    pull += around_.areas[f] * offset * normal;
    volume += around_.areas[f] * normal;
  }
  double best = infinity;
  Eigen::Vector3d best_x = Eigen::Vector3d::Zero();
  const auto offer = [&](const Eigen::Vector3d& x) {
    const double cost = cost_at(x);
    if (cost >= best) return;
    for (std::size_t i = 0; i < around_.link.size(); ++i) {
      const Point apex = around_.middle + around_.size * x.transpose();
      const Point normal =
          (at(surface_.origin[around_.link[i]]) - apex).cross(at(surface_.target(around_.link[i])) - apex);
      if (!(normal.dot(around_.link_normals[i]) > turn_ * normal.norm())) return;
    }
    best = cost;
    best_x = x;
  };
  const Eigen::Vector3d end = (at(surface_.origin[h]) - around_.middle).transpose() / around_.size;
  for (Eigen::Vector3d x : {Eigen::Vector3d(squares.ldlt().solve(pull)), Eigen::Vector3d(Eigen::Vector3d::Zero()), end,
                            Eigen::Vector3d(-end)}) {
    if (push_outside(x)) offer(x);
  }
  const Optimum least = minimise(volume, around_.planes, 1.5);
  if (least.status == Optimum::Status::optimal) offer(least.x);
  place = around_.middle + around_.size * best_x.transpose();
  return best * around_.size * around_.size * around_.size;
}

void Simplifier::consider(int h) {
  h = std::min(h, surface_.twin[h]);
  Point place;
  computed_[h] = step_;
  const double cost = best_place(h, place);
  if (cost < infinity) candidates_.push({cost, h, step_});
}

// A vertex of two faces would be left where a third corner has only three.
bool Simplifier::keeps_valence(int h) const {
  for (const int side : {h, surface_.twin[h]}) {
    const int start = HalfEdgeSphere::previous(side);
    int g = start, valence = 0;
    do ++valence;
    while ((g = surface_.around(g)) != start);
    if (valence < 4) return false;
  }
  return true;
}

// Whether a face that stays, and has none of `ends` as a corner, crosses a triangle of the fan.
bool Simplifier::fan_crosses(int face, const Fan& fan, const std::array<int, 2>& ends) const {
  const std::array<int, 3> corners{surface_.origin[3 * face], surface_.origin[3 * face + 1],
                                   surface_.origin[3 * face + 2]};
  for (const int c : corners)
    if (c == ends[0] || c == ends[1]) return false;
  const Triangle other{at(corners[0]), at(corners[1]), at(corners[2])};
  for (std::size_t i = 0; i < fan.triangles.size(); ++i) {
    const Triangle& triangle = fan.triangles[i];
    std::size_t shared = 0, in_other = 0, in_fan = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t e = 0; e < 2; ++e)
        if (corners[c] == fan.links[i][e]) ++shared, in_other = c, in_fan = e + 1;
    const auto opposite = [](const Triangle& t, std::size_t corner, const Triangle& with) {
      return segment_crosses_triangle(t[(corner + 1) % 3], t[(corner + 2) % 3], with);
    };
    if (shared == 0 && triangles_cross(triangle, other)) return true;
    if (shared == 1 && (opposite(triangle, in_fan, other) || opposite(other, in_other, triangle))) return true;
  }
  return false;
}

bool Simplifier::would_cross(int h, const Point& place) const {
  const int u = surface_.origin[h], v = surface_.target(h);
  Fan fan;
  Point low = place, high = place;
  for (const int edge : around_.link) {
    const int from = surface_.origin[edge], to = surface_.target(edge);
    fan.links.push_back({from, to});
    fan.triangles.push_back({place, at(from), at(to)});
    low = low.cwiseMin(at(from));
    high = high.cwiseMax(at(from));
  }
  // Within the fan, where all share the place.
  for (std::size_t i = 0; i < fan.links.size(); ++i)
    for (std::size_t j = 0; j < fan.links.size(); ++j) {
      if (i == j || fan.links[i][0] == fan.links[j][1] || fan.links[i][1] == fan.links[j][0]) continue;
      if (segment_crosses_triangle(fan.triangles[i][1], fan.triangles[i][2], fan.triangles[j])) return true;
    }
  const Box all{low[0], low[1], low[2], high[0], high[1], high[2]};
  for (std::size_t g = 0; g < group_boxes_.size(); ++g) {
    if (!meet(group_boxes_[g], all)) continue;
    for (std::size_t face = g * group; face < std::min((g + 1) * group, boxes_.size()); ++face)
      if (surface_.alive[3 * face] && meet(boxes_[face], all) && fan_crosses(static_cast<int>(face), fan, {u, v}))
        return true;
  }
  return false;
}

void Simplifier::collapse_to(int max_faces) {
  for (const double turn : turns) {
    turn_ = turn;
    ++step_;
    bool progress = true;
    while (faces_ > max_faces && progress) {
      progress = false;
      for (int h = 0; h < surface_.size(); ++h)
        if (surface_.alive[h] && h < surface_.twin[h]) consider(h);
      while (faces_ > max_faces && !candidates_.empty()) {
        const auto [cost, h, step] = candidates_.top();
        candidates_.pop();
        if (!surface_.alive[h] || h > surface_.twin[h] || step != computed_[h]) continue;
        const int u = surface_.origin[h];
        if (std::max(changed_[u], changed_[surface_.target(h)]) > step) {
          consider(h);
          continue;
        }
        Point place;
        if (!surface_.collapsible(h) || !keeps_valence(h) || best_place(h, place) == infinity || would_cross(h, place))
          continue;
        surface_.collapse(h);
        position_.row(u) = place;
        faces_ -= 2;
        progress = true;
        ++step_;
        set_boxes(u);
        int g = surface_.out[u];
        do changed_[surface_.target(g)] = step_;
        while ((g = surface_.around(g)) != surface_.out[u]);
        changed_[u] = step_;
        do consider(g);
        while ((g = surface_.around(g)) != surface_.out[u]);
      }
      ++step_;
    }
  }
}

Mesh Simplifier::mesh() const {
  Mesh mesh{Vertices(surface_.vertex_count, 3), surface_.faces()};
  std::vector<int> renumbered(surface_.out.size(), -1);
  int next = 0;
  for (std::size_t v = 0; v < surface_.out.size(); ++v) {
    if (surface_.out[v] < 0) continue;
    renumbered[v] = next;
    mesh.vertices.row(next++) = position_.row(static_cast<Eigen::Index>(v));
  }
  for (int& v : mesh.faces.reshaped()) v = renumbered[static_cast<std::size_t>(v)];
  return mesh;
}

}  // namespace

Mesh simplify_outwards(const Mesh& surface, int max_faces) {
  Simplifier simplifier(surface);
  simplifier.collapse_to(max_faces);
  return simplifier.mesh();
}

}  // namespace partwise
