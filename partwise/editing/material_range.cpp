#include "partwise/editing/material_range.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <cmath>
#include <utility>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr double reach = 0.95;
constexpr double least_width = 1e-3;  // of a coefficient that all materials share
constexpr double shrinkage = 0.02;    // under it each training material is likeliest, given the others

}  // namespace

at::Tensor as_tensor(const DsbrdfCoefficients& material) {
  at::Tensor row = at::empty({dsbrdf_size});
  for (int i = 0; i < dsbrdf_size; ++i) row.data_ptr<float>()[i] = static_cast<float>(material[i]);
  return row;
}

DsbrdfCoefficients as_material(const at::Tensor& row) {
  PARTWISE_CHECK(row.numel(), ==, dsbrdf_size);
  const at::Tensor values = row.detach().to(at::kDouble).contiguous();
  return Eigen::Map<const DsbrdfCoefficients>(values.data_ptr<double>());
}

MaterialRange MaterialRange::of(std::span<const DsbrdfCoefficients> materials) {
  PARTWISE_CHECK(materials.size(), >, 0u);
  DsbrdfCoefficients low = materials.front(), high = low;
  for (const DsbrdfCoefficients& each : materials) {
    low = low.cwiseMin(each);
    high = high.cwiseMax(each);
  }
  return {as_tensor(low), as_tensor(high.cwiseMax((low.array() + least_width).matrix()))};
}

MaterialRange::MaterialRange(at::Tensor low, at::Tensor high) : low_(std::move(low)), high_(std::move(high)) {
  PARTWISE_CHECK(low_.numel(), ==, dsbrdf_size);
  PARTWISE_CHECK(high_.numel(), ==, dsbrdf_size);
}

at::Tensor MaterialRange::scaled(const at::Tensor& coefficients) const {
  return ((coefficients - low_) / (high_ - low_) * 2 - 1) * reach;
}

at::Tensor MaterialRange::coefficients(const at::Tensor& scaled) const {
  return (scaled / reach + 1) / 2 * (high_ - low_) + low_;
}

at::Tensor MaterialRange::variations(std::span<const DsbrdfCoefficients> materials) const {
  PARTWISE_CHECK(materials.size(), >, 1u);
  std::vector<at::Tensor> rows;
  for (const DsbrdfCoefficients& each : materials) rows.push_back(as_tensor(each));
  const at::Tensor all = scaled(at::stack(rows));
  const at::Tensor from_mean = (all - all.mean(0, true)) / std::sqrt(static_cast<double>(materials.size() - 1));
  const double variance = from_mean.square().sum().item<double>() / dsbrdf_size;
  return at::cat({std::sqrt(1 - shrinkage) * from_mean, std::sqrt(shrinkage * variance) * at::eye(dsbrdf_size)});
}

}  // namespace partwise
