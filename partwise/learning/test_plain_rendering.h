// The sum (3.2) as one writes it with tensors, differentiated by autograd: what the rendering layer is judged by, for
// its gradients and for its time. Tests and benchmarks only; not installed.
#pragma once

#include <torch/types.h>

#include <cmath>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/environment_light.h"

namespace partwise::test {

class PlainRendering {
 public:
  PlainRendering(int height, int width, at::ScalarType type) {
    const auto empty = [&](int columns) { return torch::empty({height * width, columns}, torch::kDouble); };
    at::Tensor directions = empty(3), halves = empty(3), angles = empty(1), basis = empty(spline_size);
    for (int i = 0; i < height * width; ++i) {
      const Eigen::Vector3d direction = equirectangular_direction(i % width, i / width, width, height);
      const Eigen::Vector3d half = (direction + Eigen::Vector3d::UnitZ()).normalized();
      const SplineWeights weights = spline_weights(std::acos(half.z()));
      std::copy_n(direction.data(), 3, directions.data_ptr<double>() + 3 * i);
      std::copy_n(half.data(), 3, halves.data_ptr<double>() + 3 * i);
      std::copy_n(weights.data(), spline_size, basis.data_ptr<double>() + spline_size * i);
      angles.data_ptr<double>()[i] = equirectangular_solid_angle(i / width, width, height);
    }
    to_light_ = directions.t().contiguous().to(type);
    half_ = halves.t().contiguous().to(type);
    basis_ = basis.t().contiguous().to(type);
    solid_angle_ = angles.reshape({-1}).to(type);
  }

  // normals n x 3, material 108, light 3 x h x w; n x 3 colours.
  at::Tensor colours(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light) const {
    const at::Tensor curves = material.view({3, dsbrdf_lobe_count, 2, spline_size}).matmul(basis_);
    const at::Tensor weights = light.reshape({3, -1}) * solid_angle_;
    const at::Tensor cosine = normals.matmul(to_light_).clamp_min(0), u = normals.matmul(half_);
    const at::Tensor first = u.clamp_min(least_cosine_first_lobe).log(), others = u.clamp_min(least_cosine).log();
    std::vector<at::Tensor> channels;
    for (int c = 0; c < 3; ++c) {
      at::Tensor value;
      for (int r = 0; r < dsbrdf_lobe_count; ++r) {
        const at::Tensor log_kappa = curves[c][r][0], gamma = r == 0 ? curves[c][r][1] : curves[c][r][1].exp();
        const at::Tensor exponent = (log_kappa + gamma * (r == 0 ? first : others)).exp();
        const at::Tensor lobe = exponent.clamp_max(largest_exponent).expm1();
        value = r == 0 ? lobe : value + lobe;
      }
      channels.push_back((value * cosine).matmul(weights[c]));
    }
    return torch::stack(channels, 1);
  }

 private:
  at::Tensor to_light_, half_, basis_, solid_angle_;
};

}  // namespace partwise::test
