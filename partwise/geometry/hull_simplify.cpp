#include "partwise/geometry/hull_simplify.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <queue>
#include <ranges>
#include <tuple>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/half_edge_sphere.h"
#include "partwise/geometry/linear_programme.h"

namespace partwise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double on_line = 1e-9;    // What is so near to a line or a point is taken to lie on it.
constexpr int polished_early = 24;  // From so many vertices on all are moved to their best places after each collapse.
// New vertices lie within so many standard deviations of the old ones. Near ones first: greed for volume alone grows
// spikes, which later collapses have to pay for; far ones are there to get past a dead end.
constexpr double reaches[] = {2, 8};

// The surface that is simplified. `body` is the given hull, about the origin and of unit size; the surface is a
// sphere whose every face plane has the body on its inner side, so that it is star-shaped about each point of the body
// and its convex hull encloses the body.
class Simplifier {
 public:
  explicit Simplifier(const Mesh& body);

  void collapse_to(int vertices);
  // Moves each vertex to where the volume is least while all others stay. Returns the volume gained.
  double polish();
  Vertices vertices() const;
  int vertex_count() const { return surface_.vertex_count; }

 private:
  // A plane through a half-edge that touches the body at `contact`, on the side of the half-edge's face: the new third
  // corner of that face must lie outside of it.
  struct Tangent {
    HalfSpace outside;
    int contact;
  };
  struct Candidate {
    double cost;
    int half_edge;
    int step;  // when it was computed
    bool operator<(const Candidate& other) const {
      return std::tie(other.cost, other.half_edge) < std::tie(cost, half_edge);
    }
  };

  Tangent tangent(int h, int contact) const;
  // Recomputes what depends on the position of the vertex.
  void moved(int vertex);
  // Appends to link_ the half-edges opposite `vertex` in its faces, less the faces that have `other` as a corner.
  void gather_link(int vertex, int other);
  // Where the apex of a fan over link_ adds the least volume and leaves the body inside of all face planes. Returns six
  // times the volume that the fan encloses with `origin`; infinity when there is no such apex.
  double best_apex(const Eigen::Vector3d& origin, Eigen::Vector3d& apex);
  // The volume that the collapse of h adds, and where its vertex goes.
  double collapse_cost(int h, Eigen::Vector3d& apex);
  void consider(int h);

  const Vertices body_;
  std::vector<int> neighbour_start_, neighbours_;  // of the body's vertices
  Vertices position_;
  HalfEdgeSphere surface_;
  std::vector<Tangent> tangent_;  // of each half-edge
  std::vector<int> link_;         // half-edges around the star at hand
  std::vector<HalfSpace> constraints_;
  std::priority_queue<Candidate> candidates_;
  int step_ = 0;
  double reach_ = reaches[0];
  std::vector<int> computed_;  // of each half-edge the step of its latest candidate
  std::vector<int> changed_;   // of each vertex the last step that moved it or a neighbour
};

Simplifier::Simplifier(const Mesh& body)
    : body_(body.vertices),
      position_(body.vertices),
      surface_(body),
      computed_(surface_.origin.size(), -1),
      changed_(surface_.out.size(), -1) {
  neighbour_start_.push_back(0);
  for (int v = 0; v < body_.rows(); ++v) {
    const int first = surface_.out[v];
    if (first >= 0) {
      int h = first;
      do neighbours_.push_back(surface_.target(h));
      while ((h = surface_.around(h)) != first);
    }
    neighbour_start_.push_back(static_cast<int>(neighbours_.size()));
  }
  for (int h = 0; h < surface_.size(); ++h) tangent_.push_back(tangent(h, surface_.origin[surface_.previous(h)]));
}

// Walks along the body's edges to the vertex at the largest angle about the half-edge. A vertex with no neighbour
// outside the plane is the last one, since the body is convex.
Simplifier::Tangent Simplifier::tangent(int h, int contact) const {
  const Eigen::Vector3d a = position_.row(surface_.origin[h]), b = position_.row(surface_.target(h));
  // The edge between a vertex and a neighbour that it fell on bounds nothing.
  if ((b - a).norm() < on_line) return {{Eigen::Vector3d::Zero(), 0}, contact};
  const Eigen::Vector3d along = (b - a).normalized();
  const Eigen::Vector3d inwards = (along.dot(a) * along - a).normalized();  // to the origin, which is inside
  const Eigen::Vector3d left = along.cross(inwards);
  const auto polar = [&](int v) -> Eigen::Vector2d {
    const Eigen::Vector3d p = body_.row(v).transpose() - a;
    return {inwards.dot(p), left.dot(p)};
  };
  if (polar(contact).norm() < on_line)  // A vertex on the line itself tells no direction: start from the farthest.
    for (int v = 0; v < body_.rows(); ++v)
      if (polar(v).squaredNorm() > polar(contact).squaredNorm()) contact = v;
  Eigen::Vector2d direction = polar(contact);
  // By angle from `inwards` in (-180, 180] degrees. Only within a half is the cross product a measure: in a flat part
  // of the body the two tangents are opposite, and rounding must not turn one into the other.
  const auto further = [&](const Eigen::Vector2d& q) {
    if ((direction.y() >= 0) != (q.y() >= 0)) return q.y() >= 0;
    return direction.x() * q.y() - direction.y() * q.x() > 1e-14;
  };
  bool turned = true;
  for (Eigen::Index turns = 0; turned && turns < body_.rows(); ++turns) {
    turned = false;
    direction.normalize();
    for (int i = neighbour_start_[contact]; i < neighbour_start_[contact + 1]; ++i) {
      const Eigen::Vector2d q = polar(neighbours_[i]);
      if (q.norm() < on_line || !further(q)) continue;
      contact = neighbours_[i];
      direction = q;
      turned = true;
      break;
    }
  }
  const Eigen::Vector3d normal = direction.x() * left - direction.y() * inwards;
  return {{normal, std::max(normal.dot(a), normal.dot(b))}, contact};
}

void Simplifier::moved(int vertex) {
  changed_[vertex] = step_;
  int h = surface_.out[vertex];
  do {
    for (int g : {h, surface_.twin[h]}) tangent_[g] = tangent(g, tangent_[g].contact);
    changed_[surface_.target(h)] = step_;
  } while ((h = surface_.around(h)) != surface_.out[vertex]);
}

void Simplifier::gather_link(int vertex, int other) {
  int h = surface_.out[vertex];
  do {
    const int opposite = surface_.next(h);
    if (surface_.origin[opposite] != other && surface_.target(opposite) != other) link_.push_back(opposite);
  } while ((h = surface_.around(h)) != surface_.out[vertex]);
}

double Simplifier::best_apex(const Eigen::Vector3d& origin, Eigen::Vector3d& apex) {
  const auto shifted = [&](const HalfSpace& plane) -> HalfSpace {
    return {plane.normal, plane.offset - plane.normal.dot(origin)};
  };
  Eigen::Vector3d cost = Eigen::Vector3d::Zero();
  constraints_.clear();
  for (int h : link_) {
    const Eigen::Vector3d a = position_.row(surface_.origin[h]), b = position_.row(surface_.target(h));
    cost += (a - origin).cross(b - origin);
    constraints_.push_back(shifted(tangent_[h].outside));
  }
  // An apex beyond the tangent on the far side of a link edge would turn that face's back to the body.
  for (int h : link_) {
    const HalfSpace plane = shifted(tangent_[surface_.twin[h]].outside);
    constraints_.push_back({-plane.normal, -plane.offset});
  }
  const Optimum optimum = minimise(cost, constraints_, reach_);
  if (optimum.status != Optimum::Status::optimal) return infinity;
  apex = origin + optimum.x;
  // An apex often falls on a neighbour; there it shall be to the bit, lest a face without a direction be left between.
  for (int h : link_) {
    const Eigen::Vector3d neighbour = position_.row(surface_.origin[h]);
    if ((neighbour - apex).norm() < on_line) apex = neighbour;
  }
  return cost.dot(apex - origin);
}

double Simplifier::collapse_cost(int h, Eigen::Vector3d& apex) {
  const int u = surface_.origin[h], v = surface_.target(h);
  const Eigen::Vector3d origin = position_.row(u);
  const Eigen::Vector3d end = position_.row(v).transpose() - origin;
  link_.clear();
  gather_link(v, u);
  double before = 0;  // Seen from u only the faces of v that do not touch u have volume.
  for (int g : link_) {
    const Eigen::Vector3d a = position_.row(surface_.origin[g]), b = position_.row(surface_.target(g));
    before += (a - origin).cross(b - origin).dot(end);
  }
  gather_link(u, v);
  const double after = best_apex(origin, apex);
  return after - before;
}

void Simplifier::consider(int h) {
  h = std::min(h, surface_.twin[h]);
  Eigen::Vector3d apex;
  computed_[h] = step_;
  const double cost = collapse_cost(h, apex);
  if (cost < infinity) candidates_.push({cost, h, step_});
}

void Simplifier::collapse_to(int vertices) {
  std::size_t tried = 0;  // reaches at which no edge was left to collapse
  while (surface_.vertex_count > vertices && tried < std::size(reaches)) {
    bool progress = false;
    reach_ = reaches[tried];
    for (int h = 0; h < surface_.size(); ++h)
      if (surface_.alive[h] && h < surface_.twin[h]) consider(h);
    while (surface_.vertex_count > vertices && !candidates_.empty()) {
      const auto [cost, h, step] = candidates_.top();
      candidates_.pop();
      if (!surface_.alive[h] || h > surface_.twin[h] || step != computed_[h]) continue;
      const int vertex = surface_.origin[h];
      if (std::max(changed_[vertex], changed_[surface_.target(h)]) > step) {
        consider(h);
        continue;
      }
      if (!surface_.collapsible(h)) continue;
      Eigen::Vector3d apex;
      PARTWISE_CHECK(collapse_cost(h, apex), ==, cost);  // Nothing that it depends on has changed.
      surface_.collapse(h);
      position_.row(vertex) = apex;
      progress = true;
      ++step_;
      moved(vertex);
      int g = surface_.out[vertex];
      do consider(g);
      while ((g = surface_.around(g)) != surface_.out[vertex]);
      if (surface_.vertex_count <= polished_early) {
        ++step_;
        polish();
      }
    }
    ++step_;
    if (!progress) ++tried;
  }
  reach_ = reaches[0];
}

double Simplifier::polish() {
  double gained = 0;
  for (int v = 0; v < position_.rows(); ++v) {
    if (surface_.out[v] < 0) continue;
    link_.clear();
    gather_link(v, -1);
    Eigen::Vector3d apex;
    const Eigen::Vector3d origin = position_.row(v);
    const double change = best_apex(origin, apex);
    if (!(change < 0)) continue;
    gained -= change / 6;
    position_.row(v) = apex;
    moved(v);
  }
  return gained;
}

Vertices Simplifier::vertices() const {
  std::vector<int> left;
  for (int v = 0; v < position_.rows(); ++v)
    if (surface_.out[v] >= 0) left.push_back(v);
  return position_(left, Eigen::all);
}

// The frame in which the points have the unit matrix for their second moments. Volumes keep their order under linear
// maps and so does enclosure, but slivers become round and tolerances mean the same in all directions.
Eigen::Matrix3d round_frame(const Vertices& points) {
  const Eigen::Matrix3d moments = points.transpose() * points / static_cast<double>(points.rows());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(moments);
  const Eigen::Vector3d spread = principal.eigenvalues().cwiseMax(1e-24 * principal.eigenvalues()[2]).cwiseSqrt();
  const Eigen::Matrix3d frame = principal.eigenvectors() * spread.asDiagonal();
  return frame.determinant() < 0 ? -frame : frame;  // A mirror would turn the faces inside out.
}

// The tetrahedron of supporting planes with the normals of a regular one.
Vertices enclosing_tetrahedron(const Vertices& points) {
  Eigen::Matrix<double, 4, 3> normals;
  normals << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  const Eigen::Vector4d reach = (points * normals.transpose()).colwise().maxCoeff().transpose();
  Vertices corners(4, 3);
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix3d planes;
    Eigen::Vector3d offsets;
    for (int j = 0, row = 0; j < 4; ++j) {
      if (j == i) continue;
      planes.row(row) = normals.row(j);
      offsets[row++] = reach[j];
    }
    corners.row(i) = (planes.inverse() * offsets).transpose();
  }
  return corners;
}

// The convex hull of the corners, scaled up about `centre`, by no more than rounding asks for, until it encloses;
// without faces when the centre itself lies outside, so that no scale would do.
Mesh enclosing_hull(const Vertices& corners, const Vertices& points, const Point& centre) {
  const double size = (points.rowwise() - centre).rowwise().norm().maxCoeff();
  double scale = 1;
  for (int attempt = 0; attempt < 60; ++attempt) {
    const Vertices scaled = (scale * corners).rowwise() + centre;
    Mesh mesh = convex_hull(scaled, 1e-12 * size).mesh;
    const Vertices local = mesh.vertices.rowwise() - centre;
    const auto planes = hull_planes({local, mesh.faces});
    const Vertices inside = points.rowwise() - centre;
    double excess = 0, inradius = infinity;
    for (const auto& plane : planes.rowwise()) {
      excess = std::max(excess, (inside * plane.head<3>().transpose()).maxCoeff() - plane[3]);
      inradius = std::min(inradius, plane[3]);
    }
    if (excess <= 0) return mesh;
    if (inradius <= 0) return {};
    scale *= 1 + 2 * std::max(excess / inradius, 1e-16);
  }
  throw CheckFailed("simplify_hull: rounding left a point outside");
}

}  // namespace

Mesh simplify_hull(const Mesh& hull, int max_vertices) {
  if (max_vertices < 4)
    throw InputError("max_vertices", fmt::format("{} vertices enclose no volume", max_vertices), "ask for 4 or more");
  if (hull.vertices.rows() <= max_vertices) return hull;
  const Point centre = hull.vertices.colwise().mean();
  const Vertices centred = hull.vertices.rowwise() - centre;
  const Eigen::Matrix3d frame = round_frame(centred);
  const Vertices round = centred * frame.inverse().transpose();

  Simplifier simplifier({round, hull.faces});
  simplifier.collapse_to(max_vertices);
  for (int sweep = 0; sweep < 20 && simplifier.polish() > 1e-4; ++sweep) {
  }
  Mesh tetrahedron = enclosing_hull(enclosing_tetrahedron(round) * frame.transpose(), hull.vertices, centre);
  PARTWISE_CHECK(tetrahedron.faces.rows(), ==, 4);
  if (simplifier.vertex_count() > max_vertices) return tetrahedron;
  Mesh simple = enclosing_hull(simplifier.vertices() * frame.transpose(), hull.vertices, centre);
  return simple.faces.rows() == 0 || signed_volume(tetrahedron) < signed_volume(simple) ? tetrahedron : simple;
}

}  // namespace partwise
