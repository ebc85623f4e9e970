// Training on pictures that are drawn as they are needed (edit_samples.h): what the tasks of this room share.
#pragma once

#include <vector>

#include "partwise/editing/edit_samples.h"
#include "partwise/learning/training_task.h"

namespace partwise {

// Of the terms of a loss, in one stage; those that a task does not know count for nothing.
struct EditingWeights {
  double normal = 1, material = 1, light = 0.1, pixel = 1, perceptual = 0;
};

struct EditingTaskSettings {
  std::vector<EditingWeights> stages;
  bool given_normals = false, given_light = false;
  int layer_light = 32;  // columns
  int layer_map = 32;    // texels along a side
  int perceptual_side = 64;
  std::int64_t validation_batches = 8;
};

class SampledTask : public TrainingTask {
 public:
  // The samples must outlive this.
  SampledTask(const EditSamples& training, const EditSamples& validation, const EditingTaskSettings& settings)
      : training_(training), validation_(validation), settings_(settings) {}

  Losses training_losses(std::int64_t step, int stage, const Rows& rows) final {
    return losses(training_.batch(static_cast<std::uint64_t>(step), rows), weights_of(stage));
  }
  Losses validation_losses(std::int64_t batch, int stage, const Rows& rows) final {
    return losses(validation_.batch(static_cast<std::uint64_t>(batch), rows), weights_of(stage));
  }
  std::int64_t validation_batches() const final { return settings_.validation_batches; }

 protected:
  const EditingTaskSettings& settings() const { return settings_; }
  virtual Losses losses(const EditBatch& batch, const EditingWeights& weights) const = 0;

 private:
  const EditingWeights& weights_of(int stage) const { return settings_.stages[static_cast<std::size_t>(stage)]; }

  const EditSamples& training_;
  const EditSamples& validation_;
  EditingTaskSettings settings_;
};

}  // namespace partwise
