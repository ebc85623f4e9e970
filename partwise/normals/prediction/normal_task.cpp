#include "partwise/normals/prediction/normal_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <torch/nn/module.h>

#include <algorithm>
#include <utility>

#include "partwise/editing/picture_terms.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise {

NormalTask::NormalTask(NormalPredictor predictor, std::optional<EditingNetworks> readers, const EditSamples& training,
                       const EditSamples& validation, const EditingTaskSettings& settings)
    : SampledTask(training, validation, settings), predictor_(std::move(predictor)), readers_(std::move(readers)) {
  if (readers_) readers_->module().eval();
  if (std::ranges::any_of(settings.stages, [](const EditingWeights& each) { return each.perceptual > 0; }))
    features_.emplace(PerceptualFeatures::shipped());
}

// Region by region, for a map is one material's.
at::Tensor NormalTask::rendered(const at::Tensor& normals, const EditBatch& batch) const {
  at::Tensor light;
  if (readers_) {
    const at::NoGradGuard as_they_are;
    light = reduced_light(radiance_of_log(readers_->log_radiance(batch.pictures)), settings().layer_light);
  }
  const auto region_image = [&](const at::Tensor& region, int number) {
    const at::Tensor seen = normals * region;
    if (!readers_) return looked_up_images(seen, batch.maps.select(1, number), batch.map_size);
    const at::NoGradGuard as_they_are;
    const at::Tensor material = readers_->range().coefficients(readers_->scaled_material(batch.pictures * region));
    const at::Tensor maps = reflectance_maps(material, light, settings().layer_map);
    const at::AutoGradMode gradient(normals.requires_grad());
    return looked_up_images(seen, maps, settings().layer_map);
  };
  const at::Tensor image = region_image(1 - batch.other_parts, 0);
  if (!batch.other_parts.any().item<bool>()) return image;
  return image + region_image(batch.other_parts, 1);
}

Losses NormalTask::losses(const EditBatch& batch, const EditingWeights& weights) const {
  Losses result;
  const at::Tensor normals = predictor_(batch.pictures);
  if (weights.normal > 0)
    result.add("normal", weights.normal, 3 * object_mean((normals - batch.normals).square(), batch.mask()));
  if (weights.pixel == 0 && weights.perceptual == 0) return result;
  const at::Tensor image = display_values(rendered(normals, batch)), truth = display_values(batch.image);
  if (weights.pixel > 0) result.add("pixel", weights.pixel, object_mean((image - truth).square(), batch.mask()));
  if (weights.perceptual > 0) {
    result.add(
        "perceptual", weights.perceptual,
        reduced_perceptual_distance(*features_, image.clamp_max(1), truth.clamp_max(1), settings().perceptual_side));
  }
  return result;
}

}  // namespace partwise
