#include "partwise/editing/error_levels.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <algorithm>
#include <cmath>

#include "partwise/base/error.h"

namespace partwise {
namespace {

at::Tensor enlarged(const at::Tensor& level, std::int64_t rows, std::int64_t columns) {
  return at::upsample_bilinear2d(level, {rows, columns}, false);
}

// With a column more at either side, which the enlarged field loses again.
at::Tensor enlarged_around(const at::Tensor& level, std::int64_t rows, std::int64_t columns) {
  const std::int64_t width = level.size(3), margin = columns / width;
  const at::Tensor wider = at::cat({level.narrow(3, width - 1, 1), level, level.narrow(3, 0, 1)}, 3);
  return enlarged(wider, rows, columns + 2 * margin).narrow(3, margin, columns);
}

}  // namespace

ErrorLevels::ErrorLevels(std::int64_t rows, std::int64_t columns, std::span<const double> deviations, bool wraps)
    : rows_(rows), columns_(columns), wraps_(wraps) {
  for (std::size_t k = 0; k < deviations.size() && std::int64_t{1} << k <= rows; ++k) {
    const std::int64_t height = std::int64_t{1} << k;
    levels_.push_back(at::zeros({1, 3, height, std::max(height * columns / rows, std::int64_t{1})}));
    deviations_.push_back(deviations[k]);
  }
}

at::Tensor ErrorLevels::field() const {
  at::Tensor result = at::zeros({1, 3, rows_, columns_});
  for (std::size_t k = 0; k < levels_.size(); ++k) {
    const at::Tensor level =
        wraps_ ? enlarged_around(levels_[k], rows_, columns_) : enlarged(levels_[k], rows_, columns_);
    result = result + deviations_[k] * level;
  }
  return result;
}

at::Tensor ErrorLevels::square() const {
  at::Tensor result = at::zeros({});
  for (const at::Tensor& each : levels_) result = result + each.square().sum();
  return result;
}

std::vector<double> level_deviations(const at::Tensor& field, const at::Tensor& mask) {
  PARTWISE_CHECK(mask.sum().item<double>(), >, 0);
  std::vector<double> result;
  at::Tensor fine = field, inside = mask;
  const auto add = [&](const at::Tensor& values) {
    const double squares = (values.square() * inside).sum().item<double>();
    result.push_back(std::sqrt(squares / (3 * inside.sum().item<double>())));
  };
  while (fine.size(2) > 1) {
    PARTWISE_CHECK(fine.size(2) % 2, ==, 0);
    const at::Tensor share = at::avg_pool2d(inside, {2, 2});
    const at::Tensor coarse = at::avg_pool2d(fine * inside, {2, 2}) / share.clamp_min(1e-6);
    const at::Tensor known = (share > 0).to(at::kFloat);
    const auto up = [&](const at::Tensor& values) { return enlarged(values, fine.size(2), fine.size(3)); };
    add(fine - up(coarse) / up(known).clamp_min(1e-6));  // where it is not known it has no part
    fine = coarse;
    inside = known;
  }
  add(fine);
  std::ranges::reverse(result);
  return result;
}

}  // namespace partwise
