// The rendering layer for scenes, whose every pixel has a material of its own (dissertation, section 4.3): K numbers a
// pixel, of functional principal components (appearance/material/dsbrdf_basis.h), in place of 108.
//
//   I_c(p) = sum over light pixels i of f_c(n_p . h_i; theta_d_i; mean + sum over k of psi_pk component_k)
//                                       L_ci max(0, n_p . w_i) dw_i
//
// as exact_images (rendering_layer.h) has it for one material, with the same bounds; differentiable in normals, psi and
// light, analytically. The 108 coefficients of a pixel are there while it is worked on and never as an image: memory is
// that of what goes in and comes out. Time: twice that of exact_images, its gradient four times: 22 and 61 ms of a core
// for 96 x 96 pixels, 32 numbers each, under a light of 16 x 8.
//
// Shapes: normals B x 3 x H x W, unit vectors, zero where there is nothing; psi B x K x H x W; light B x 3 x h x w;
// basis: mean 108, components K x 108. Result B x 3 x H x W, linear RGB, zero where there is nothing. Float or double,
// on the CPU, one type for all. Pixels in parallel: the same bits for any number of threads. Errors: CheckFailed for
// other shapes or types.
#pragma once

#include <ATen/core/Tensor.h>

namespace partwise {

struct DsbrdfBasis;

struct CoefficientBasis {
  at::Tensor mean, components;

  static CoefficientBasis of(const DsbrdfBasis& basis, at::ScalarType type = at::kFloat);
};

at::Tensor coefficient_images(const at::Tensor& normals, const at::Tensor& psi, const at::Tensor& light,
                              const CoefficientBasis& basis);

}  // namespace partwise
