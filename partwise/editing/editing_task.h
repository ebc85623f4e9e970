// The joint training of the networks that read normals, material and light off a picture, through the rendering layer
// (dissertation, section 3.3.3). Terms of a row's loss, each with a weight of its own in each stage; a term whose
// weight is 0 is not computed:
//
//   normal      mean over the object's pixels of |n - n'|^2, from 0 to 4  (3.3)
//   material    mean over the 108 coefficients of (m - m')^2, scaled to [-0.95, 0.95]  (3.4)
//   light       mean over the sphere of (log L - log L')^2, all channels; the dissertation names none
//   pixel       mean over the object's pixels and channels of (I - I')^2 and (O - O')^2, summed, of display values
//   perceptual  the same two of features of VGG-16 (learning/perceptual_features.h), of images scaled to a side
//
// I' is rendered from n', m' and L', O' from n', the target material and L', by the reflectance-map form of the layer
// under L' reduced to `layer_light` columns. Terms that are `given` are true instead of predicted, as section 3.4.3
// does for normals and light when it evaluates the material network. The weights of (3.5), 1e4, 1e3 and 1, are those of
// sums over pixels and of VGG's units; docs/training.md has ours.
#pragma once

#include <optional>
#include <vector>

#include "partwise/editing/edit_samples.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/learning/perceptual_features.h"
#include "partwise/learning/training_task.h"

namespace partwise {

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

class EditingTask final : public TrainingTask {
 public:
  // The samples must outlive this.
  EditingTask(EditingNetworks networks, const EditSamples& training, const EditSamples& validation,
              const EditingTaskSettings& settings);

  torch::nn::Module& network() override { return networks_.module(); }
  WeightsFile weights() const override { return networks_.weights(); }
  Losses training_losses(std::int64_t step, int stage, const Rows& rows) override;
  Losses validation_losses(std::int64_t batch, int stage, const Rows& rows) override;
  std::int64_t validation_batches() const override { return settings_.validation_batches; }

 private:
  Losses losses(const EditBatch& batch, const EditingWeights& weights) const;

  EditingNetworks networks_;
  const EditSamples& training_;
  const EditSamples& validation_;
  EditingTaskSettings settings_;
  MaterialRange range_;
  std::optional<PerceptualFeatures> features_;
};

// 1 x 1 x h x 1: what a pixel of each row of a map counts on the sphere, 1 in the mean.
at::Tensor row_weights(std::int64_t rows);

// Mean over the object's pixels and channels, a row; of a row without object 0. Values B x C x S x S, mask B x 1 x S x
// S.
at::Tensor object_mean(const at::Tensor& values, const at::Tensor& mask);

// The perceptual distance of images that are reduced to a side first, a row.
at::Tensor reduced_perceptual_distance(const PerceptualFeatures& features, const at::Tensor& a, const at::Tensor& b,
                                       int side);

// Maps of radiance, B x 3 x h x w, reduced to fewer columns; energy is kept.
at::Tensor reduced_light(const at::Tensor& radiance, int columns);

}  // namespace partwise
