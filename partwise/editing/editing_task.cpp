#include "partwise/editing/editing_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <algorithm>
#include <utility>

#include "partwise/editing/picture_terms.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise {

EditingTask::EditingTask(EditingNetworks networks, const EditSamples& training, const EditSamples& validation,
                         const EditingTaskSettings& settings)
    : SampledTask(training, validation, settings), networks_(std::move(networks)), range_(networks_.range()) {
  if (std::ranges::any_of(settings.stages, [](const EditingWeights& each) { return each.perceptual > 0; }))
    features_.emplace(PerceptualFeatures::shipped());
}

Losses EditingTask::losses(const EditBatch& batch, const EditingWeights& weights) const {
  Losses result;
  const bool rendered = weights.pixel > 0 || weights.perceptual > 0;
  at::Tensor normals = batch.normals, radiance = batch.radiance, material;
  if (!settings().given_normals && (weights.normal > 0 || rendered)) {
    normals = networks_.normals(batch.pictures);
    if (weights.normal > 0)
      result.add("normal", weights.normal, 3 * object_mean((normals - batch.normals).square(), batch.mask()));
  }
  if (weights.material > 0 || rendered) {
    material = networks_.scaled_material(batch.pictures);
    if (weights.material > 0)
      result.add("material", weights.material, (material - range_.scaled(batch.material)).square().mean(1));
  }
  if (!settings().given_light && (weights.light > 0 || rendered)) {
    const at::Tensor log_radiance = networks_.log_radiance(batch.pictures);
    const at::Tensor difference = (log_radiance - log_of_radiance(batch.radiance)).square();
    if (weights.light > 0) result.add("light", weights.light, (difference * row_weights(light_rows)).mean({1, 2, 3}));
    radiance = radiance_of_log(log_radiance);
  }
  if (!rendered) return result;

  const at::Tensor light = reduced_light(radiance, settings().layer_light);
  const auto shown = [&](const at::Tensor& coefficients) {
    return mapped_images(normals, coefficients, light, settings().layer_map);
  };
  const at::Tensor image = display_values(shown(range_.coefficients(material)));
  // One picture does not tell how bright the light is, only how bright together with the material.
  const at::Tensor target = display_values(exposed_as(shown(batch.target_material), batch.target, batch.mask()));
  const at::Tensor true_image = display_values(batch.image).clamp_max(1);
  const at::Tensor true_target = display_values(batch.target).clamp_max(1);
  if (weights.pixel > 0) {
    result.add("pixel", weights.pixel,
               object_mean((image - true_image).square(), batch.mask()) +
                   object_mean((target - true_target).square(), batch.mask()));
  }
  if (weights.perceptual > 0) {
    const auto distance = [&](const at::Tensor& a, const at::Tensor& b) {
      return reduced_perceptual_distance(*features_, a, b, settings().perceptual_side);
    };
    result.add("perceptual", weights.perceptual, distance(image, true_image) + distance(target, true_target));
  }
  return result;
}

}  // namespace partwise
