#include "partwise/motion/contact_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/motion/even_points.h"
#include "partwise/motion/sample_tree.h"

namespace partwise {
namespace {

template <typename Hull>
ContactSamples sampled(const std::vector<Hull>& hulls, const std::vector<int>& obstacles, int each) {
  PARTWISE_CHECK(hulls.size(), ==, obstacles.size());
  const int count = obstacles.empty() ? 0 : *std::ranges::max_element(obstacles) + 1;
  std::vector<double> whole(static_cast<std::size_t>(count), 0.0);
  for (std::size_t i = 0; i < hulls.size(); ++i)
    whole[static_cast<std::size_t>(obstacles[i])] += boundary_size(hulls[i]);
  std::vector<MotionVector> points;
  std::vector<int> labels;
  for (std::size_t i = 0; i < hulls.size(); ++i) {
    const double share = boundary_size(hulls[i]) / whole[static_cast<std::size_t>(obstacles[i])];
    const int wanted = std::max(3, static_cast<int>(std::lround(share * each)));
    for (const BoundaryPoint& point : even_points(std::span(&hulls[i], 1), wanted)) points.push_back(point.at);
    labels.resize(points.size(), obstacles[i]);
  }
  return assembled(points, std::move(labels), count);
}

}  // namespace

ContactSamples assembled(const std::vector<MotionVector>& points, std::vector<int> obstacles, int count) {
  ContactSamples result;
  result.points.resize(static_cast<Eigen::Index>(points.size()), points.empty() ? 0 : points.front().size());
  for (std::size_t i = 0; i < points.size(); ++i)
    result.points.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  result.obstacles = std::move(obstacles);
  result.count = count;
  return result;
}

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
