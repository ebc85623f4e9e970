#include "partwise/learning/coefficient_sum.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "partwise/base/error.h"
#include "partwise/learning/lobe_lanes.h"

namespace partwise {
namespace {

using namespace lanes;
using Index = Eigen::Index;

constexpr Index pixel_block = 512;

inline double exponential(double value) { return std::exp(value); }
inline float8::Float8 exponential(const float8::Float8& value) { return float8::exp(value); }

// Rows of a column from `first` on, lane by lane; zeros beyond the last.
template <typename Scalar, typename Column>
typename Lanes<Scalar>::Value lanes_of(const Column& column, Index first) {
  std::array<Scalar, Lanes<Scalar>::width> values{};
  const Index count = std::min<Index>(Lanes<Scalar>::width, column.size() - first);
  for (Index i = 0; i < count; ++i) values[static_cast<std::size_t>(i)] = column[first + i];
  return load(values.data());
}
template <typename Scalar, typename Column>
void set_lanes(Column&& column, Index first, const typename Lanes<Scalar>::Value& value) {
  std::array<Scalar, Lanes<Scalar>::width> values;
  std::memcpy(values.data(), &value, sizeof(value));
  const Index count = std::min<Index>(Lanes<Scalar>::width, column.size() - first);
  for (Index i = 0; i < count; ++i) column[first + i] = values[static_cast<std::size_t>(i)];
}

template <typename Work>
void for_pixel_blocks(Index rows, const Work& work) {
  tbb::parallel_for(Index(0), (rows + pixel_block - 1) / pixel_block, [&](Index block) {
    work(static_cast<std::size_t>(block), block * pixel_block, std::min(rows, (block + 1) * pixel_block));
  });
}

}  // namespace

// A lane's worth of pixels: their normals and all coefficients of their materials.
template <typename Scalar>
struct CoefficientSum<Scalar>::Some {
  using Value = typename Lanes<Scalar>::Value;

  std::array<Value, 3> normal;
  std::array<Value, dsbrdf_size> material;

  Some(const CoefficientSum& sum, const PlanesRef<Scalar>& normals, const NumbersRef<Scalar>& psi, Index first) {
    for (Index k = 0; k < 3; ++k) normal[static_cast<std::size_t>(k)] = lanes_of<Scalar>(normals.col(k), first);
    for (Index j = 0; j < dsbrdf_size; ++j) material[static_cast<std::size_t>(j)] = Value{} + sum.mean_[j];
    for (Index k = 0; k < psi.cols(); ++k) {
      const Value number = lanes_of<Scalar>(psi.col(k), first);
      for (Index j = 0; j < dsbrdf_size; ++j) material[static_cast<std::size_t>(j)] += number * sum.components_(j, k);
    }
  }
};

// The nine lobes of such pixels at one light pixel.
template <typename Scalar>
struct CoefficientSum<Scalar>::Lobes {
  using Value = typename Lanes<Scalar>::Value;

  std::array<Value, lobe_total> log_kappa, gamma;

  Lobes(const LightPixel<Scalar>& pixel, const Some& some) {
    const auto curve = [&](int lobe, DsbrdfCurve which) {
      const auto from = static_cast<std::size_t>(curve_at(lobe, which));
      Value value{};
      for (std::size_t k = 0; k < spline_size; ++k) value += some.material[from + k] * pixel.basis[k];
      return value;
    };
    constexpr auto bound = static_cast<Scalar>(largest_log_gamma);
    for (int lobe = 0; lobe < lobe_total; ++lobe) {
      const auto at = static_cast<std::size_t>(lobe);
      log_kappa[at] = curve(lobe, DsbrdfCurve::kappa);
      gamma[at] = curve(lobe, DsbrdfCurve::gamma);
      if (!signed_gamma(lobe)) gamma[at] = exponential(largest(least(gamma[at], Value{} + bound), Value{} - bound));
    }
  }

  LobeValue<Value> at(std::size_t lobe, const HalfCosines<Scalar>& half) const {
    return lobe_value(log_kappa[lobe] + gamma[lobe] * half.log(static_cast<int>(lobe) % dsbrdf_lobe_count));
  }
};

template <typename Scalar>
CoefficientSum<Scalar>::CoefficientSum(const std::vector<LightPixel<Scalar>>& grid, const Coefficients<Scalar>& mean,
                                       const NumbersRef<Scalar>& components, const PlanesRef<Scalar>& radiance)
    : grid_(grid), mean_(mean), components_(components), weights_(radiance) {
  PARTWISE_CHECK(components.rows(), ==, dsbrdf_size);
  PARTWISE_CHECK(static_cast<std::size_t>(radiance.rows()), ==, grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) weights_.row(static_cast<Index>(i)) *= grid[i].solid_angle;
}

template <typename Scalar>
Planes<Scalar> CoefficientSum<Scalar>::colours(const PlanesRef<Scalar>& normals, const NumbersRef<Scalar>& psi) const {
  using Value = typename Lanes<Scalar>::Value;
  PARTWISE_CHECK(psi.rows(), ==, normals.rows());
  PARTWISE_CHECK(psi.cols(), ==, components_.cols());
  Planes<Scalar> result = Planes<Scalar>::Zero(normals.rows(), 3);
  for_pixel_blocks(normals.rows(), [&](std::size_t, Index from, Index to) {
    for (Index row = from; row < to; row += Lanes<Scalar>::width) {
      const Some some(*this, normals, psi, row);
      std::array<Value, 3> colour{};
      for (std::size_t i = 0; i < grid_.size(); ++i) {
        const auto weight = weights_.row(static_cast<Index>(i));
        if ((weight == 0).all()) continue;
        const Value cosine = dot(some.normal, grid_[i].direction);
        if (!any_positive(cosine)) continue;
        const HalfCosines<Scalar> half(some.normal, grid_[i].half_vector);
        const Lobes lobes(grid_[i], some);
        for (std::size_t lobe = 0; lobe < lobe_total; ++lobe) {
          const std::size_t channel = lobe / dsbrdf_lobe_count;
          colour[channel] +=
              lobes.at(lobe, half).value * largest(cosine, Value{}) * weight[static_cast<Index>(channel)];
        }
      }
      for (Index c = 0; c < 3; ++c) set_lanes<Scalar>(result.col(c), row, colour[static_cast<std::size_t>(c)]);
    }
  });
  return result;
}

template <typename Scalar>
CoefficientGradient<Scalar> CoefficientSum<Scalar>::gradient(const PlanesRef<Scalar>& normals,
                                                             const NumbersRef<Scalar>& psi,
                                                             const PlanesRef<Scalar>& of_colours) const {
  using Value = typename Lanes<Scalar>::Value;
  PARTWISE_CHECK(psi.rows(), ==, normals.rows());
  PARTWISE_CHECK(psi.cols(), ==, components_.cols());
  PARTWISE_CHECK(of_colours.rows(), ==, normals.rows());
  CoefficientGradient<Scalar> result{Planes<Scalar>::Zero(normals.rows(), 3), Planes<Scalar>::Zero(weights_.rows(), 3),
                                     Numbers<Scalar>::Zero(psi.rows(), psi.cols())};
  std::vector<Planes<Scalar>> light_parts(static_cast<std::size_t>((normals.rows() + pixel_block - 1) / pixel_block));
  for_pixel_blocks(normals.rows(), [&](std::size_t block, Index from, Index to) {
    Planes<Scalar>& of_radiance = light_parts[block];
    of_radiance = Planes<Scalar>::Zero(weights_.rows(), 3);
    for (Index row = from; row < to; row += Lanes<Scalar>::width) {
      const Some some(*this, normals, psi, row);
      std::array<Value, 3> given, of_normal{};
      for (Index c = 0; c < 3; ++c) given[static_cast<std::size_t>(c)] = lanes_of<Scalar>(of_colours.col(c), row);
      std::array<Value, dsbrdf_size> of_material{};
      for (std::size_t i = 0; i < grid_.size(); ++i) {
        const LightPixel<Scalar>& pixel = grid_[i];
        const auto weight = weights_.row(static_cast<Index>(i));
        const Value cosine = dot(some.normal, pixel.direction);
        if (!any_positive(cosine)) continue;
        const HalfCosines<Scalar> half(some.normal, pixel.half_vector);
        const Lobes lobes(pixel, some);
        Value of_cosine{}, of_half_cosine{};
        std::array<Value, 3> sums{};
        for (int lobe = 0; lobe < lobe_total; ++lobe) {
          const auto at = static_cast<std::size_t>(lobe), channel = at / dsbrdf_lobe_count;
          const int r = lobe % dsbrdf_lobe_count;
          const Value seen = cosine > 0 ? given[channel] * weight[static_cast<Index>(channel)] : Value{};
          const LobeValue<Value> found = lobes.at(at, half);
          const Value of_log_kappa = seen * cosine * found.slope;
          const Value of_gamma = of_log_kappa * half.log(r);
          const Value of_curve = signed_gamma(lobe) ? of_gamma : Value(of_gamma * lobes.gamma[at]);
          for (std::size_t k = 0; k < spline_size; ++k) {
            of_material[static_cast<std::size_t>(curve_at(lobe, DsbrdfCurve::kappa)) + k] +=
                of_log_kappa * pixel.basis[k];
            of_material[static_cast<std::size_t>(curve_at(lobe, DsbrdfCurve::gamma)) + k] += of_curve * pixel.basis[k];
          }
          sums[channel] += found.value;
          of_cosine += seen * found.value;
          of_half_cosine += of_log_kappa * lobes.gamma[at] * half.log_slope(r);
        }
        for (std::size_t k = 0; k < 3; ++k) {
          of_normal[k] += of_cosine * pixel.direction[k] + of_half_cosine * pixel.half_vector[k];
          const Value arriving = cosine > 0 ? given[k] * cosine * sums[k] : Value{};
          of_radiance(static_cast<Index>(i), static_cast<Index>(k)) += pixel.solid_angle * sum(arriving);
        }
      }
      for (Index c = 0; c < 3; ++c)
        set_lanes<Scalar>(result.normals.col(c), row, of_normal[static_cast<std::size_t>(c)]);
      for (Index k = 0; k < psi.cols(); ++k) {
        Value number{};
        for (Index j = 0; j < dsbrdf_size; ++j) number += of_material[static_cast<std::size_t>(j)] * components_(j, k);
        set_lanes<Scalar>(result.psi.col(k), row, number);
      }
    }
  });
  for (const Planes<Scalar>& part : light_parts) result.radiance += part;
  return result;
}

template class CoefficientSum<float>;
template class CoefficientSum<double>;

}  // namespace partwise
