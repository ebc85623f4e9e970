#include "partwise/normals/prediction/scene_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <torch/nn/module.h>

#include <algorithm>
#include <utility>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/error.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/picture_terms.h"

namespace partwise {
namespace {

constexpr std::int64_t stride = 2;

}  // namespace

SceneTask::SceneTask(SceneNetworks networks, const SceneFrames& training, const SceneFrames& validation,
                     const SceneTaskSettings& settings)
    : networks_(std::move(networks)),
      training_(training),
      validation_(validation),
      settings_(settings),
      basis_(CoefficientBasis::of(shipped_basis().first(default_components))) {
  const bool pictures = std::ranges::any_of(settings.stages, [](const EditingWeights& each) { return each.pixel > 0; });
  if (pictures && !settings.given) PARTWISE_CHECK(networks_.settings().readers, ==, true);
}

Losses SceneTask::training_losses(std::int64_t step, int stage, const Rows& rows) {
  const SceneBatch batch = training_.batch(settings_.seed, static_cast<std::uint64_t>(step), rows, true);
  return losses(batch, settings_.stages[static_cast<std::size_t>(stage)], {step % stride, step / stride % stride});
}

Losses SceneTask::validation_losses(std::int64_t number, int stage, const Rows& rows) {
  const SceneBatch batch = validation_.batch(settings_.seed, static_cast<std::uint64_t>(number), rows, false);
  return losses(batch, settings_.stages[static_cast<std::size_t>(stage)], {});
}

Losses SceneTask::losses(const SceneBatch& batch, const EditingWeights& weights, const Lattice& lattice) const {
  Losses result;
  const at::Tensor normals = networks_.normals()(batch.pictures);
  if (weights.normal > 0) {
    const at::Tensor known = (batch.normals.square().sum(1, true) > 0).to(at::kFloat);
    result.add("normal", weights.normal, 3 * object_mean((normals - batch.normals).square(), known));
  }
  if (weights.pixel > 0) add_picture_terms(batch, normals, weights, lattice, result);
  return result;
}

void SceneTask::add_picture_terms(const SceneBatch& batch, const at::Tensor& normals, const EditingWeights& weights,
                                  const Lattice& lattice, Losses& result) const {
  const auto thinned = [&](const at::Tensor& planes) {
    return planes.slice(2, lattice.y, {}, stride).slice(3, lattice.x, {}, stride).contiguous();
  };
  at::Tensor materials = batch.materials, log_radiance = batch.log_radiance, seen = batch.mask();
  if (settings_.given) {
    seen = batch.materials_known * batch.light_known;
  } else {
    materials = networks_.materials(batch.pictures);
    log_radiance = networks_.log_radiance(batch.pictures);
    if (weights.material > 0)
      result.add("material", weights.material,
                 object_mean((materials - batch.materials).square(), batch.materials_known));
    if (weights.light > 0) {
      const at::Tensor errors = (log_radiance - batch.log_radiance).square() * row_weights(log_radiance.size(2));
      result.add("light", weights.light, (errors * batch.light_known).mean({1, 2, 3}));
    }
  }
  const at::Tensor mask = thinned(seen);
  const at::Tensor image =
      coefficient_images(thinned(normals) * mask, thinned(materials), radiance_of_log(log_radiance), basis_);
  const at::Tensor truth = thinned(batch.pictures.narrow(1, 0, 3));
  result.add("pixel", weights.pixel, object_mean((display_values(image).clamp_max(1) - truth).square(), mask));
}

}  // namespace partwise
