#include "partwise/appearance/rendering/light_sum.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "partwise/appearance/rendering/float8.h"
#include "partwise/appearance/rendering/lobe_values.h"
#include "partwise/appearance/rendering/shading_frame.h"

namespace partwise {
namespace {

using namespace float8;

constexpr Eigen::Index together = 8;
constexpr int channels = 3, lobes = dsbrdf_lobe_count;

}  // namespace

Eigen::Vector3d half_vector(const Eigen::Vector3d& to_light) {
  const Eigen::Vector3d sum = to_light + Eigen::Vector3d::UnitZ();
  const double length = sum.norm();
  return length > 1e-6 ? Eigen::Vector3d(sum / length) : Eigen::Vector3d::UnitX();
}

Eigen::ArrayX3f half_vectors(const LightSamples& light) {
  Eigen::ArrayX3f half(light.size(), 3);
  for (Eigen::Index i = 0; i < light.size(); ++i) {
    half.row(i) = half_vector(light.direction(i).cast<double>()).cast<float>().transpose();
  }
  return half;
}

LightSum::LightSum(const Brdf& material, const LightSamples& light) : material_(material), light_(light) {
  const auto* dsbrdf = dynamic_cast<const Dsbrdf*>(&material);
  if (dsbrdf == nullptr) return;
  has_lobes_ = true;
  half_ = half_vectors(light);
  kappa_.resize(light.size(), Eigen::NoChange);
  gamma_.resize(light.size(), Eigen::NoChange);
  tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, light.size(), 64), [&](const auto& range) {
    for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
      const DsbrdfLobes at = dsbrdf->lobes(std::acos(std::clamp(half_(i, 2), 0.0f, 1.0f)));
      for (int c = 0; c < channels; ++c) {
        for (int r = 0; r < lobes; ++r) {
          kappa_(i, lobes * c + r) = static_cast<float>(at.kappa(c, r));
          gamma_(i, lobes * c + r) = static_cast<float>(at.gamma(c, r));
        }
      }
    }
  });
}

Eigen::Vector3f LightSum::colour(const Eigen::Vector3f& normal, const float* visible) const {
  return has_lobes_ ? lobes_colour(normal, visible) : any_colour(normal, visible);
}

std::vector<Eigen::Vector3f> LightSum::colours(std::span<const Eigen::Vector3f> normals) const {
  std::vector<Eigen::Vector3f> result(normals.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), 16), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) result[i] = colour(normals[i]);
  });
  return result;
}

Eigen::Vector3f LightSum::lobes_colour(const Eigen::Vector3f& normal, const float* visible) const {
  const std::array<const float*, channels> radiance{light_.red.data(), light_.green.data(), light_.blue.data()};
  std::array<Float8, channels> sums{};
  for (Eigen::Index i = 0; i < light_.size(); i += together) {
    Float8 cosine = normal.x() * load(&light_.x[i]) + normal.y() * load(&light_.y[i]) + normal.z() * load(&light_.z[i]);
    if (visible != nullptr) cosine *= load(visible + i);
    if (!any_positive(cosine)) continue;
    cosine = largest(cosine, all(0));
    const Float8 dx = normal.x() - load(&half_(i, 0)), dy = normal.y() - load(&half_(i, 1)),
                 dz = normal.z() - load(&half_(i, 2));
    const LogCosines cosines(0.5f * (dx * dx + dy * dy + dz * dz));  // 1 - n.h by the chord
    for (int c = 0; c < channels; ++c) {
      const Float8 value = lobe_sum(
          cosines, [&](int lobe) { return load(&kappa_(i, lobes * c + lobe)); },
          [&](int lobe) { return load(&gamma_(i, lobes * c + lobe)); });
      sums[static_cast<std::size_t>(c)] += value * cosine * load(radiance[static_cast<std::size_t>(c)] + i);
    }
  }
  return {sum(sums[0]), sum(sums[1]), sum(sums[2])};
}

Eigen::Vector3f LightSum::any_colour(const Eigen::Vector3f& normal, const float* visible) const {
  const ShadingFrame frame(normal);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < light_.size(); ++i) {
    const Eigen::Vector3f direction = light_.direction(i);
    const float cosine = normal.dot(direction) * (visible == nullptr ? 1 : visible[i]);
    if (!(cosine > 0)) continue;
    const Eigen::Vector3f value = material_(frame.local(direction), frame.to_viewer);
    sum +=
        (cosine * value.cwiseProduct(Eigen::Vector3f(light_.red[i], light_.green[i], light_.blue[i]))).cast<double>();
  }
  return sum.cast<float>();
}

}  // namespace partwise
