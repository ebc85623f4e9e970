#include "partwise/editing/editing_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <algorithm>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise {
at::Tensor row_weights(std::int64_t rows) {
  at::Tensor weights = at::empty({1, 1, rows, 1});
  for (std::int64_t y = 0; y < rows; ++y) {
    weights.data_ptr<float>()[y] =
        static_cast<float>(equirectangular_solid_angle(static_cast<int>(y), 1, static_cast<int>(rows)));
  }
  return weights / weights.mean();
}

at::Tensor object_mean(const at::Tensor& values, const at::Tensor& mask) {
  const at::Tensor sums = (values * mask).mean(1).sum({1, 2});
  return sums / mask.sum({1, 2, 3}).clamp_min(1);
}

at::Tensor reduced_perceptual_distance(const PerceptualFeatures& features, const at::Tensor& a, const at::Tensor& b,
                                       int side) {
  if (a.size(3) == side) return perceptual_distance(features, a, b);
  return perceptual_distance(features, at::adaptive_avg_pool2d(a, {side, side}),
                             at::adaptive_avg_pool2d(b, {side, side}));
}

at::Tensor reduced_light(const at::Tensor& radiance, int columns) {
  const std::int64_t rows = radiance.size(2), step = radiance.size(3) / columns;
  if (step == 1) return radiance;
  PARTWISE_CHECK(radiance.size(3) % columns, ==, 0);
  PARTWISE_CHECK(rows % step, ==, 0);
  const at::Tensor weights = row_weights(rows).to(radiance.scalar_type());
  return at::avg_pool2d(radiance * weights, {step, step}) / at::avg_pool2d(weights, {step, 1});
}

EditingTask::EditingTask(EditingNetworks networks, const EditSamples& training, const EditSamples& validation,
                         const EditingTaskSettings& settings)
    : networks_(std::move(networks)),
      training_(training),
      validation_(validation),
      settings_(settings),
      range_(networks_.range()) {
  const bool perceptual = std::ranges::any_of(settings_.stages, [](const auto& each) { return each.perceptual > 0; });
  if (perceptual) features_.emplace(PerceptualFeatures::shipped());
}

Losses EditingTask::training_losses(std::int64_t step, int stage, const Rows& rows) {
  return losses(training_.batch(static_cast<std::uint64_t>(step), rows),
                settings_.stages[static_cast<std::size_t>(stage)]);
}

Losses EditingTask::validation_losses(std::int64_t batch, int stage, const Rows& rows) {
  return losses(validation_.batch(static_cast<std::uint64_t>(batch), rows),
                settings_.stages[static_cast<std::size_t>(stage)]);
}

Losses EditingTask::losses(const EditBatch& batch, const EditingWeights& weights) const {
  Losses result;
  result.total = at::zeros({});
  const auto add = [&](const char* name, double weight, const at::Tensor& rows) {
    const at::Tensor mean = rows.mean();
    result.terms.emplace_back(name, mean.item<double>());
    result.total = result.total + weight * mean;
  };
  const bool rendered = weights.pixel > 0 || weights.perceptual > 0;
  at::Tensor normals = batch.normals, radiance = batch.radiance, material;
  if (!settings_.given_normals && (weights.normal > 0 || rendered)) {
    normals = networks_.normals(batch.pictures);
    if (weights.normal > 0)
      add("normal", weights.normal, 3 * object_mean((normals - batch.normals).square(), batch.mask()));
  }
  if (weights.material > 0 || rendered) {
    material = networks_.scaled_material(batch.pictures);
    if (weights.material > 0)
      add("material", weights.material, (material - range_.scaled(batch.material)).square().mean(1));
  }
  if (!settings_.given_light && (weights.light > 0 || rendered)) {
    const at::Tensor log_radiance = networks_.log_radiance(batch.pictures);
    const at::Tensor difference = (log_radiance - log_of_radiance(batch.radiance)).square();
    if (weights.light > 0) add("light", weights.light, (difference * row_weights(light_rows)).mean({1, 2, 3}));
    radiance = radiance_of_log(log_radiance);
  }
  if (!rendered) return result;

  const at::Tensor light = reduced_light(radiance, settings_.layer_light);
  const auto shown = [&](const at::Tensor& coefficients) {
    return display_values(mapped_images(normals, coefficients, light, settings_.layer_map));
  };
  const at::Tensor image = shown(range_.coefficients(material)), target = shown(batch.target_material);
  const at::Tensor true_image = display_values(batch.image).clamp_max(1);
  const at::Tensor true_target = display_values(batch.target).clamp_max(1);
  if (weights.pixel > 0) {
    add("pixel", weights.pixel,
        object_mean((image - true_image).square(), batch.mask()) +
            object_mean((target - true_target).square(), batch.mask()));
  }
  if (weights.perceptual > 0) {
    const auto distance = [&](const at::Tensor& a, const at::Tensor& b) {
      return reduced_perceptual_distance(*features_, a, b, settings_.perceptual_side);
    };
    add("perceptual", weights.perceptual, distance(image, true_image) + distance(target, true_target));
  }
  return result;
}

}  // namespace partwise
