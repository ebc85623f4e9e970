#include "partwise/normals/truth/normal_measures.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr double steps_a_degree = 1000;

// Of vectors of any length; 0 where one of them is none.
double cosine_between(const float* a, const float* b) {
  const Eigen::Vector3d u = Eigen::Map<const Eigen::Vector3f>(a).cast<double>();
  const Eigen::Vector3d v = Eigen::Map<const Eigen::Vector3f>(b).cast<double>();
  const double cosine = u.dot(v) / (u.norm() * v.norm());
  return std::isfinite(cosine) ? std::clamp(cosine, -1.0, 1.0) : 0;
}

bool is_normal(const float* values) {
  const float square = Eigen::Map<const Eigen::Vector3f>(values).squaredNorm();
  return std::isfinite(square) && square > 0;
}

void check_size(const Image& image, const Image& truth, int channels) {
  PARTWISE_CHECK(image.width, ==, truth.width);
  PARTWISE_CHECK(image.height, ==, truth.height);
  PARTWISE_CHECK(image.channels, ==, channels);
}

}  // namespace

NormalMeasure::NormalMeasure() : counts_(static_cast<std::size_t>(180 * steps_a_degree) + 1) {}

void NormalMeasure::add(const Image& normals, const Image& truth) { add(normals, truth, nullptr); }

void NormalMeasure::add(const Image& normals, const Image& truth, const Mask& mask) {
  check_size(mask, truth, 1);
  add(normals, truth, &mask);
}

void NormalMeasure::add(const Image& normals, const Image& truth, const Mask* mask) {
  check_size(truth, truth, 3);
  check_size(normals, truth, 3);
  for (std::size_t i = 0; i < truth.values.size() / 3; ++i) {
    const float* expected = truth.values.data() + 3 * i;
    if (!is_normal(expected) || (mask != nullptr && !(mask->values[i] > 0.5f))) continue;
    const double cosine = cosine_between(normals.values.data() + 3 * i, expected);
    const double angle = std::acos(cosine) * 180 / std::numbers::pi;
    ++pixels_;
    angles_ += angle;
    squares_ += angle * angle;
    cosines_ += cosine;
    for (std::size_t k = 0; k < below_.size(); ++k) below_[k] += angle < normal_error_limits[k] ? 1 : 0;
    ++counts_[static_cast<std::size_t>(std::lround(steps_a_degree * angle))];
  }
}

void NormalMeasure::add(const NormalMeasure& other) {
  pixels_ += other.pixels_;
  angles_ += other.angles_;
  squares_ += other.squares_;
  cosines_ += other.cosines_;
  for (std::size_t k = 0; k < below_.size(); ++k) below_[k] += other.below_[k];
  for (std::size_t k = 0; k < counts_.size(); ++k) counts_[k] += other.counts_[k];
}

double NormalMeasure::rank(std::uint64_t number) const {
  std::uint64_t before = 0;
  std::size_t k = 0;
  while (before + counts_[k] <= number) before += counts_[k++];
  return static_cast<double>(k) / steps_a_degree;
}

NormalErrors NormalMeasure::errors() const {
  NormalErrors errors;
  if (pixels_ == 0) return errors;
  const auto all = static_cast<double>(pixels_);
  errors.pixels = pixels_;
  errors.mean = angles_ / all;
  errors.median = (rank((pixels_ - 1) / 2) + rank(pixels_ / 2)) / 2;
  errors.rmse = std::sqrt(squares_ / all);
  for (std::size_t k = 0; k < below_.size(); ++k) errors.share_below[k] = static_cast<double>(below_[k]) / all;
  errors.cosine = cosines_ / all;
  return errors;
}

}  // namespace partwise
