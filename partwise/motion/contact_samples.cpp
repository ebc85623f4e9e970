#include "partwise/motion/contact_samples.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/motion/sample_tree.h"

namespace partwise {
namespace {

double size_of(const Ring& hull) {
  double perimeter = 0;
  for (Eigen::Index i = 0, j = hull.rows() - 1; i < hull.rows(); j = i++)
    perimeter += (hull.row(i) - hull.row(j)).norm();
  return perimeter;
}

double size_of(const Mesh& hull) {
  const std::vector<double> areas = face_areas(hull);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

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

// `count` points, evenly by size; `across` runs through a golden-ratio sequence.
template <typename Hull>
void add_points(const Hull& hull, int count, std::vector<MotionVector>& points) {
  constexpr double golden = 0.6180339887498949;
  const std::vector<double> sizes = pieces(hull);
  const double step = std::accumulate(sizes.begin(), sizes.end(), 0.0) / count;
  double at = 0.5 * step, start = 0;
  int taken = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    for (; taken < count && at < start + sizes[i]; at += step, ++taken) {
      const double across = std::fmod((taken + 0.5) * golden, 1.0);
      points.push_back(point_of(hull, static_cast<Eigen::Index>(i), (at - start) / sizes[i], across).transpose());
    }
    start += sizes[i];
  }
}

ContactSamples assembled(const std::vector<MotionVector>& points, std::vector<int> obstacles, int count) {
  ContactSamples result;
  result.points.resize(static_cast<Eigen::Index>(points.size()), points.empty() ? 0 : points.front().size());
  for (std::size_t i = 0; i < points.size(); ++i)
    result.points.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  result.obstacles = std::move(obstacles);
  result.count = count;
  return result;
}

template <typename Hull>
ContactSamples sampled(const std::vector<Hull>& hulls, const std::vector<int>& obstacles, int each) {
  PARTWISE_CHECK(hulls.size(), ==, obstacles.size());
  const int count = obstacles.empty() ? 0 : *std::ranges::max_element(obstacles) + 1;
  std::vector<double> whole(static_cast<std::size_t>(count), 0.0);
  for (std::size_t i = 0; i < hulls.size(); ++i) whole[static_cast<std::size_t>(obstacles[i])] += size_of(hulls[i]);
  std::vector<MotionVector> points;
  std::vector<int> labels;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    const double share = size_of(hulls[i]) / whole[static_cast<std::size_t>(obstacles[i])];
    add_points(hulls[i], std::max(3, static_cast<int>(std::lround(share * each))), points);
    labels.resize(points.size(), obstacles[i]);
  }
  return assembled(points, std::move(labels), count);
}

}  // namespace

ContactSamples contact_samples(const std::vector<Ring>& hulls, const std::vector<int>& obstacles, int each) {
  return sampled(hulls, obstacles, each);
}

ContactSamples contact_samples(const std::vector<Mesh>& hulls, const std::vector<int>& obstacles, int each) {
  return sampled(hulls, obstacles, each);
}

ContactSamples thinned(const ContactSamples& samples, double density) {
  const SampleTree tree(samples);
  std::vector<std::vector<MotionVector>> kept(static_cast<std::size_t>(samples.count));
  std::vector<std::vector<double>> apart(kept.size());
  std::vector<MotionVector> points;
  std::vector<int> labels;
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    const int obstacle = samples.obstacles[static_cast<std::size_t>(i)];
    const MotionVector x = samples.points.row(i).transpose();
    const double radius = density * tree.nearest_other(x, obstacle).distance;
    auto& near = kept[static_cast<std::size_t>(obstacle)];
    auto& radii = apart[static_cast<std::size_t>(obstacle)];
    bool crowded = false;
    for (std::size_t k = 0; k < near.size() && !crowded; ++k)
      crowded = (near[k] - x).norm() < std::min(radius, radii[k]);
    if (crowded) continue;
    near.push_back(x);
    radii.push_back(radius);
    points.push_back(x);
    labels.push_back(obstacle);
  }
  return assembled(points, std::move(labels), samples.count);
}

}  // namespace partwise
