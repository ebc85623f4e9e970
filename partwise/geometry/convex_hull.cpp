#include "partwise/geometry/convex_hull.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Principal axes of the points, ascending by variance.
Eigen::Matrix3d principal_axes(const Vertices& points) {
  const Vertices centred = points.rowwise() - points.colwise().mean();
  const Eigen::Matrix3d covariance = centred.transpose() * centred;
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
}

double extent(const Vertices& points, const Eigen::Vector3d& axis) {
  const Eigen::VectorXd along = points * axis;
  return along.maxCoeff() - along.minCoeff();
}

// Doubles the points along every principal axis in which they are thinner than the minimum, and along the thinnest in
// any case: Qhull may have found no volume in a set that is a little thicker.
Vertices thicken(const Vertices& points, double minimum_thickness) {
  const Eigen::Matrix3d axes = principal_axes(points);
  Vertices thick = points;
  for (int k = 0; k < 3; ++k) {
    if (k > 0 && extent(points, axes.col(k)) >= minimum_thickness) continue;
    const Point shift = axes.col(k).transpose() * (minimum_thickness / 2);
    Vertices doubled(2 * thick.rows(), 3);
    doubled << thick.rowwise() - shift, thick.rowwise() + shift;
    thick = std::move(doubled);
  }
  return thick;
}

// Facets of the hull as corners into `points`, counter-clockwise from outside; empty when Qhull fails with these
// options.
std::vector<std::array<int, 3>> qhull_facets(const Vertices& points, const char* options) {
  struct Session {
    qhT qh;
    Session() { qh_zero(&qh, nullptr); }
    ~Session() {
      qh_freeqhull(&qh, !qh_ALL);
      int kept, bytes;
      qh_memfreeshort(&qh, &kept, &bytes);
    }
  };
  const auto session = std::make_unique<Session>();
  qhT* qh = &session->qh;
  static const std::unique_ptr<FILE, int (*)(FILE*)> silence(std::fopen("/dev/null", "w"), &std::fclose);
  std::string command = std::string("qhull ") + options;
  const int failed = qh_new_qhull(qh, 3, static_cast<int>(points.rows()), const_cast<double*>(points.data()), False,
                                  command.data(), nullptr, silence.get());
  std::vector<std::array<int, 3>> facets;
  if (failed) return facets;
  facetT* facet;
  FORALLfacets {
    std::array<int, 3> corner{};
    int k = 0;
    vertexT *vertex, **vertexp;
    FOREACHvertex_(facet->vertices) {
      if (k < 3) corner[k] = qh_pointid(qh, vertex->point);
      ++k;
    }
    PARTWISE_CHECK(k, ==, 3);
    // Qhull's `toporient` tells the order of the vertices in the set.
    if (facet->toporient != qh_ORIENTclock) std::swap(corner[0], corner[1]);
    facets.push_back(corner);
  }
  return facets;
}

// Facets that are not triangles are cut into such. Where many points lie nearly in a plane, Qhull may refuse to merge
// them into one facet, however thick the whole is; it succeeds when it may move the points by some rounding errors.
std::vector<std::array<int, 3>> facets_of(const Vertices& points) {
  std::vector<std::array<int, 3>> facets = qhull_facets(points, "Qt");
  if (facets.empty()) facets = qhull_facets(points, "QJ");
  return facets;
}

}  // namespace

ConvexHull convex_hull(const Vertices& points, double minimum_thickness) {
  if (points.rows() == 0) throw InputError("convex hull", "there are no points", "give at least one");
  PARTWISE_CHECK(minimum_thickness, >, 0.0);
  ConvexHull hull;
  std::vector<std::array<int, 3>> facets;
  if (points.rows() >= 4) {
    const Eigen::Matrix3d axes = principal_axes(points);
    if (extent(points, axes.col(0)) >= minimum_thickness) facets = facets_of(points);
  }
  Vertices thick;
  hull.thickened = facets.empty();
  if (hull.thickened) {
    thick = thicken(points, minimum_thickness);
    facets = facets_of(thick);
    PARTWISE_CHECK(facets.size(), >=, 4u);
  }
  const Vertices& corners = hull.thickened ? thick : points;

  std::vector<int> index(static_cast<std::size_t>(corners.rows()), -1);
  std::vector<int> used;
  for (const auto& f : facets)
    for (int v : f)
      if (index[v] < 0) index[v] = 0, used.push_back(v);
  std::sort(used.begin(), used.end());
  for (std::size_t i = 0; i < used.size(); ++i) index[used[i]] = static_cast<int>(i);
  hull.mesh.vertices = corners(used, Eigen::all);
  hull.mesh.faces.resize(static_cast<Eigen::Index>(facets.size()), 3);
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (int k = 0; k < 3; ++k) hull.mesh.faces(static_cast<Eigen::Index>(f), k) = index[facets[f][k]];
  hull.volume = signed_volume(hull.mesh);
  // Thickening stacks whole copies of the points.
  for (int& v : used) v %= static_cast<int>(points.rows());
  hull.source = std::move(used);
  return hull;
}

Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> hull_planes(const Mesh& hull) {
  constexpr double kSliver = 1e-3;  // height, of the hull's size: rounding turns lower triangles noticeably
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> planes(hull.faces.rows(), 4);
  const Eigen::Matrix<double, 3, Eigen::Dynamic> corners = hull.vertices.transpose();
  const Point middle = hull.vertices.colwise().mean();
  const double size = (hull.vertices.colwise().maxCoeff() - hull.vertices.colwise().minCoeff()).norm();
  Eigen::Index count = 0;
  for (const auto& f : hull.faces.rowwise()) {
    const Point a = hull.vertices.row(f[0]), b = hull.vertices.row(f[1]), c = hull.vertices.row(f[2]);
    const Point normal = (b - a).cross(c - a);
    const double length = normal.norm();
    if (length == 0) continue;  // A sliver between three points of a line bounds nothing.
    const Point unit = normal / length;
    // Of the three corners the outermost, whatever rounding did to the normal.
    double offset = std::max({unit.dot(a), unit.dot(b), unit.dot(c)});
    // A flat side with many corners has slivers that stand across the hull or look inwards: they hold all corners.
    const double longest = std::max({(b - a).norm(), (c - a).norm(), (c - b).norm()});
    if (length < kSliver * size * longest || unit.dot(middle) >= offset) offset = (unit * corners).maxCoeff();
    planes.row(count++) << unit, offset;
  }
  planes.conservativeResize(count, 4);
  return planes;
}

}  // namespace partwise
