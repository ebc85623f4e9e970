// The coefficients of materials, brought to a common scale for networks (dissertation, section 3.3.2): each is mapped
// from the range that it has over some materials to [-0.95, 0.95], so that a tanh reaches all of them and a little
// more.
//
// Shapes: coefficients B x 108 as in appearance/material/dsbrdf.h; low and high 108. Errors: CheckFailed for other
// shapes, or no material.
#pragma once

#include <ATen/core/Tensor.h>

#include <span>

#include "partwise/appearance/material/dsbrdf.h"

namespace partwise {

at::Tensor as_tensor(const DsbrdfCoefficients& material);  // 108 floats
DsbrdfCoefficients as_material(const at::Tensor& row);

class MaterialRange {
 public:
  static MaterialRange of(std::span<const DsbrdfCoefficients> materials);
  MaterialRange(at::Tensor low, at::Tensor high);

  const at::Tensor& low() const { return low_; }
  const at::Tensor& high() const { return high_; }

  at::Tensor scaled(const at::Tensor& coefficients) const;
  at::Tensor coefficients(const at::Tensor& scaled) const;

  // What materials differ by: (n + 108) x 108 rows, scaled, whose sum with independent weights of unit variance has the
  // covariance of the n materials, shrunk a little towards one variance for all coefficients, for others differ in
  // other ways as well.
  at::Tensor variations(std::span<const DsbrdfCoefficients> materials) const;

 private:
  at::Tensor low_, high_;
};

}  // namespace partwise
