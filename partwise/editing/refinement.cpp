#include "partwise/editing/refinement.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <torch/optim/lbfgs.h>

#include <algorithm>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise {
namespace {

at::Tensor unit(const at::Tensor& vectors, const at::Tensor& mask) {
  return vectors / (vectors.square().sum(1, true) + 1e-12).sqrt() * mask;
}

class Energy {
 public:
  Energy(const PictureLayers& start, const MaterialRange& range, const at::Tensor& picture,
         const std::vector<at::Tensor>& regions, const RefinementSettings& settings)
      : start_(start),
        range_(range),
        image_(picture.narrow(1, 0, 3)),
        mask_(picture.narrow(1, 3, 1)),
        regions_(regions),
        settings_(settings),
        weights_(row_weights(start.log_radiance.size(2))),
        light_share_(mask_.sum().item<double>() / static_cast<double>(start.log_radiance[0][0].numel())) {}

  // n* is the direction of what is optimised.
  PictureLayers directions(const PictureLayers& point) const {
    return {unit(point.normals, mask_), point.material, point.log_radiance};
  }

  at::Tensor image_error(const PictureLayers& at) const {
    const at::Tensor shown = rendered(at, range_, regions_, settings_);
    const at::Tensor too_bright = (shown > 1).logical_and(image_ >= white);
    return at::where(too_bright, at::zeros({}), (shown - image_).square()).mul(mask_).sum();
  }

  at::Tensor operator()(const PictureLayers& point) const {
    const PictureLayers at = directions(point);
    const at::Tensor of_light = ((at.log_radiance - start_.log_radiance).square() * weights_).sum() * light_share_;
    return image_error(at) + settings_.normal_weight * (at.normals - start_.normals).square().sum() +
           settings_.light_weight * of_light +
           settings_.material_weight * (at.material - start_.material).square().sum();
  }

  // Mean over the object's pixels and channels, 0 to 255 squared.
  double mean_error(const PictureLayers& at) const {
    const at::NoGradGuard no_gradient;
    const double pixels = std::max(mask_.sum().item<double>(), 1.0);
    return 255.0 * 255.0 * image_error(at).item<double>() / (3 * pixels);
  }

 private:
  static constexpr double white = 254.5 / 255;

  const PictureLayers& start_;
  const MaterialRange& range_;
  at::Tensor image_, mask_;
  const std::vector<at::Tensor>& regions_;
  const RefinementSettings& settings_;
  at::Tensor weights_;
  double light_share_;
};

void minimise(const Energy& energy, PictureLayers& point, at::Tensor& variable, int steps) {
  variable = variable.detach().clone().requires_grad_();
  torch::optim::LBFGS optimiser({variable},
                                torch::optim::LBFGSOptions(1).max_iter(steps).line_search_fn("strong_wolfe"));
  optimiser.step([&] {
    optimiser.zero_grad();
    at::Tensor value = energy(point);
    value.backward();
    return value;
  });
  variable = variable.detach();
}

}  // namespace

at::Tensor rendered(const PictureLayers& found, const MaterialRange& range, const std::vector<at::Tensor>& regions,
                    const RefinementSettings& settings) {
  PARTWISE_CHECK(found.material.size(0), ==, static_cast<std::int64_t>(regions.size()));
  const at::Tensor light = reduced_light(radiance_of_log(found.log_radiance), settings.layer_light);
  const at::Tensor coefficients = range.coefficients(found.material);
  at::Tensor image = at::zeros_like(found.normals);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const at::Tensor normals = found.normals * regions[i];
    const at::Tensor row = coefficients.narrow(0, static_cast<std::int64_t>(i), 1);
    image = image + display_values(mapped_images(normals, row, light, settings.layer_map));
  }
  return image;
}

Refinement refined(const PictureLayers& start, const MaterialRange& range, const at::Tensor& picture,
                   const std::vector<at::Tensor>& regions, const RefinementSettings& settings,
                   const Progress& progress) {
  const Energy energy(start, range, picture, regions, settings);
  PictureLayers point = start;
  const double before = energy.mean_error(start);
  const at::AutoGradMode with_gradient(true);
  std::vector<at::Tensor*> variables = {&point.material, &point.log_radiance};
  if (!settings.normals_known) variables.push_back(&point.normals);
  const auto minimisations = static_cast<std::size_t>(settings.rounds) * variables.size();
  for (std::size_t i = 0; i < minimisations; ++i) {
    progress("refine", static_cast<double>(i) / static_cast<double>(minimisations));
    minimise(energy, point, *variables[i % variables.size()], settings.steps);
  }
  point = energy.directions(point);
  return {point, before, energy.mean_error(point)};
}

}  // namespace partwise
