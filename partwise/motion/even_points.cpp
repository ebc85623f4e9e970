#include "partwise/motion/even_points.h"

#include <cmath>
#include <numeric>

namespace partwise {
namespace {

// Sizes of what a hull is made of, and a point of one of them.
std::vector<double> pieces(const Ring& hull) {
  std::vector<double> lengths;
  for (Eigen::Index i = 0; i < hull.rows(); ++i)
    lengths.push_back((hull.row((i + 1) % hull.rows()) - hull.row(i)).norm());
  return lengths;
}

std::vector<double> pieces(const Mesh& hull) { return face_areas(hull); }

Eigen::RowVector2d point_of(const Ring& hull, Eigen::Index side, double share, double /*across*/) {
  return (1 - share) * hull.row(side) + share * hull.row((side + 1) % hull.rows());
}

Point point_of(const Mesh& hull, Eigen::Index face, double share, double across) {
  const auto corner = [&](int i) { return hull.vertices.row(hull.faces(face, i)); };
  const double root = std::sqrt(share);
  return (1 - root) * corner(0) + root * ((1 - across) * corner(1) + across * corner(2));
}

template <typename Hull>
double size_of(const Hull& hull) {
  const std::vector<double> sizes = pieces(hull);
  return std::accumulate(sizes.begin(), sizes.end(), 0.0);
}

template <typename Hull>
std::vector<BoundaryPoint> spread(std::span<const Hull> hulls, int count, double phase) {
  constexpr double golden = 0.6180339887498949;
  double all = 0;
  for (const Hull& hull : hulls) all += size_of(hull);
  const double step = all / count;
  std::vector<BoundaryPoint> points;
  double at = phase * step, start = 0;
  int taken = 0;
  for (std::size_t number = 0; number < hulls.size(); ++number) {
    const std::vector<double> sizes = pieces(hulls[number]);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      for (; taken < count && at < start + sizes[i]; at += step, ++taken) {
        const double across = std::fmod((taken + phase) * golden, 1.0);
        points.push_back(
            {static_cast<int>(number),
             point_of(hulls[number], static_cast<Eigen::Index>(i), (at - start) / sizes[i], across).transpose()});
      }
      start += sizes[i];
    }
  }
  return points;
}

}  // namespace

double boundary_size(const Ring& hull) { return size_of(hull); }
double boundary_size(const Mesh& hull) { return size_of(hull); }

std::vector<BoundaryPoint> even_points(std::span<const Ring> hulls, int count, double phase) {
  return spread(hulls, count, phase);
}
std::vector<BoundaryPoint> even_points(std::span<const Mesh> hulls, int count, double phase) {
  return spread(hulls, count, phase);
}

}  // namespace partwise
