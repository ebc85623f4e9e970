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

#include "partwise/editing/editing_networks.h"
#include "partwise/editing/sampled_task.h"
#include "partwise/learning/perceptual_features.h"

namespace partwise {

class EditingTask final : public SampledTask {
 public:
  // The samples must outlive this.
  EditingTask(EditingNetworks networks, const EditSamples& training, const EditSamples& validation,
              const EditingTaskSettings& settings);

  torch::nn::Module& network() override { return networks_.module(); }
  WeightsFile weights() const override { return networks_.weights(); }

 private:
  Losses losses(const EditBatch& batch, const EditingWeights& weights) const override;

  EditingNetworks networks_;
  MaterialRange range_;
  std::optional<PerceptualFeatures> features_;
};

}  // namespace partwise
