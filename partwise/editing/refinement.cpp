#include "partwise/editing/refinement.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <torch/optim/lbfgs.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/editing/error_levels.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise {
namespace {

// What networks get wrong, of levels of 1, 2, 4, ... rows: measured with the shipped ones on forty pictures of
// validation shapes in training materials and light (bench/editing_errors --spread). Light is refined to 32 rows,
// which is what the layer sees of it.
constexpr std::array normal_deviations = {0.071, 0.072, 0.086, 0.095, 0.102, 0.098, 0.094, 0.089};
constexpr std::array light_deviations = {1.228, 0.664, 0.529, 0.451, 0.399, 0.351};
constexpr double material_deviation = 0.7;  // of what materials themselves differ by; chosen on validation pictures

at::Tensor unit(const at::Tensor& vectors, const at::Tensor& mask) {
  return vectors / (vectors.square().sum(1, true) + 1e-12).sqrt() * mask;
}

at::Tensor layer_light(const PictureLayers& found, const RefinementSettings& settings) {
  return reduced_light(radiance_of_log(found.log_radiance), settings.layer_light);
}

// Of each region, R x 3 x T: what its material and the light make of every normal.
at::Tensor maps_of(const PictureLayers& found, const MaterialRange& range, const RefinementSettings& settings) {
  const at::Tensor light = layer_light(found, settings), materials = range.coefficients(found.material);
  return reflectance_maps(materials, light.expand({materials.size(0), -1, -1, -1}), settings.layer_map);
}

at::Tensor image_of(const at::Tensor& normals, const at::Tensor& maps, const std::vector<at::Tensor>& regions,
                    const RefinementSettings& settings) {
  at::Tensor image = at::zeros_like(normals);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const at::Tensor map = maps.narrow(0, static_cast<std::int64_t>(i), 1);
    image = image + display_values(looked_up_images(normals * regions[i], map, settings.layer_map));
  }
  return image;
}

ErrorLevels levels_of(const at::Tensor& field, std::span<const double> deviations, bool wraps) {
  return {field.size(2), field.size(3), deviations, wraps};
}

// What the training materials differ by.
at::Tensor training_variations(const MaterialRange& range) {
  std::vector<DsbrdfCoefficients> materials;
  for (const std::string& name : training_materials()) materials.push_back(shipped_material(name).brdf.coefficients());
  return range.variations(materials);
}

// Layers on their way from a start: how far each of the three is from it, in standard deviations.
class Refiner {
 public:
  Refiner(const PictureLayers& start, const MaterialRange& range, const at::Tensor& picture,
          const std::vector<at::Tensor>& regions, const RefinementSettings& settings)
      : start_(start),
        range_(range),
        image_(picture.narrow(1, 0, 3)),
        mask_(picture.narrow(1, 3, 1)),
        regions_(regions),
        settings_(settings),
        normals_(levels_of(start.normals, normal_deviations, false)),
        light_(levels_of(start.log_radiance, light_deviations, true)),
        variations_(material_deviation * training_variations(range)),
        material_{at::zeros({start.material.size(0), variations_.size(0)})} {}

  // n* is a direction.
  PictureLayers layers() const {
    return {unit(start_.normals + normals_.field(), mask_),
            start_.material + at::matmul(material_.front(), variations_), start_.log_radiance + light_.field()};
  }

  void refine_material() {
    minimise(material_, [&](const PictureLayers& at) { return image_error(at, maps(at)); });
  }
  void refine_light() {
    const at::Tensor materials = range_.coefficients(layers().material),
                     transport = map_transport(materials, settings_.layer_light / 2, settings_.layer_light,
                                               settings_.layer_map);
    minimise(light_.levels(), [&](const PictureLayers& at) {
      return image_error(at, transported_maps(transport, layer_light(at, settings_)));
    });
  }
  void refine_normals() {
    const at::Tensor same = maps(layers());
    minimise(normals_.levels(), [&](const PictureLayers& at) { return image_error(at, same); });
  }

  // Of the layers, mean over the object's pixels and channels, 0 to 255 squared.
  double mean_error() const {
    const at::NoGradGuard no_gradient;
    const PictureLayers at = layers();
    const double pixels = std::max(mask_.sum().item<double>(), 1.0);
    return 255.0 * 255.0 * image_error(at, maps(at)).item<double>() / (3 * pixels);
  }

 private:
  static constexpr double white = 254.5 / 255;

  at::Tensor maps(const PictureLayers& at) const { return maps_of(at, range_, settings_); }

  at::Tensor image_error(const PictureLayers& at, const at::Tensor& maps) const {
    const at::Tensor shown = image_of(at.normals, maps, regions_, settings_);
    const at::Tensor too_bright = (shown > 1).logical_and(image_ >= white);
    return at::where(too_bright, at::zeros({}), (shown - image_).square()).mul(mask_).sum();
  }

  at::Tensor unlikelihood() const {
    return settings_.normal_weight * normals_.square() + settings_.light_weight * light_.square() +
           settings_.material_weight * material_.front().square().sum();
  }

  template <typename Error>
  void minimise(std::vector<at::Tensor>& variables, const Error& error) {
    const at::AutoGradMode with_gradient(true);
    for (at::Tensor& each : variables) each = each.detach().clone().requires_grad_();
    torch::optim::LBFGS optimiser(
        variables, torch::optim::LBFGSOptions(1).max_iter(settings_.steps).line_search_fn("strong_wolfe"));
    optimiser.step([&] {
      optimiser.zero_grad();
      at::Tensor value = error(layers()) + unlikelihood();
      value.backward();
      return value;
    });
    for (at::Tensor& each : variables) each = each.detach();
  }

  const PictureLayers& start_;
  const MaterialRange& range_;
  at::Tensor image_, mask_;
  const std::vector<at::Tensor>& regions_;
  const RefinementSettings& settings_;
  ErrorLevels normals_, light_;
  at::Tensor variations_;
  std::vector<at::Tensor> material_;  // one, R x as many
};

}  // namespace

at::Tensor rendered(const PictureLayers& found, const MaterialRange& range, const std::vector<at::Tensor>& regions,
                    const RefinementSettings& settings) {
  PARTWISE_CHECK(found.material.size(0), ==, static_cast<std::int64_t>(regions.size()));
  return image_of(found.normals, maps_of(found, range, settings), regions, settings);
}

Refinement refined(const PictureLayers& start, const MaterialRange& range, const at::Tensor& picture,
                   const std::vector<at::Tensor>& regions, const RefinementSettings& settings,
                   const Progress& progress) {
  PARTWISE_CHECK(start.material.size(0), ==, static_cast<std::int64_t>(regions.size()));
  Refiner refiner(start, range, picture, regions, settings);
  const double before = refiner.mean_error();
  for (int round = 0; round < settings.rounds; ++round) {
    progress("refine", static_cast<double>(round) / settings.rounds);
    refiner.refine_material();
    refiner.refine_light();
    if (!settings.normals_known) refiner.refine_normals();
  }
  return {refiner.layers(), before, refiner.mean_error()};
}

}  // namespace partwise
