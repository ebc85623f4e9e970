// Training of a network that reads normals off a picture: by the true normals alone (dissertation, 4.1), or by what the
// picture would look like with the normals that it finds as well (4.2).
//
//   normal      mean over the object's pixels of |n - n'|^2, from 0 to 4
//   pixel       mean over the object's pixels and channels of (I - I')^2, of display values (editing/picture_terms.h),
//               those above white as well, so that it is least where n' = n
//   perceptual  the same of features of VGG-16 (learning/perceptual_features.h), of images scaled to a side
//
// Each has a weight in each stage; one whose weight is 0 is not computed. (4.1) is `normal` alone. Of (4.2), written
// with P for pixel or perceptual and lambda for the weight of the normals, a weight w of `pixel` beside 1 for `normal`
// is lambda = 1 / w in these units: w = 20 makes an error of 0.1 in each channel of each pixel count as much as normals
// that are off by 26 degrees.
//
// I' is what n' shows in the true material under the true light: given, as in Table 4.1, and looked up in the maps that
// made the picture, so that it costs next to nothing. Or, where networks of editing are given, in the material of each
// region and under the light that these, which stay as they are, read off the picture.
#pragma once

#include <optional>

#include "partwise/editing/editing_networks.h"
#include "partwise/editing/sampled_task.h"
#include "partwise/learning/perceptual_features.h"
#include "partwise/normals/prediction/normal_predictor.h"

namespace partwise {

class NormalTask final : public SampledTask {
 public:
  // The samples must outlive this.
  NormalTask(NormalPredictor predictor, std::optional<EditingNetworks> readers, const EditSamples& training,
             const EditSamples& validation, const EditingTaskSettings& settings);

  torch::nn::Module& network() override { return predictor_.module(); }
  WeightsFile weights() const override { return predictor_.weights(); }

 private:
  Losses losses(const EditBatch& batch, const EditingWeights& weights) const override;
  at::Tensor rendered(const at::Tensor& normals, const EditBatch& batch) const;

  NormalPredictor predictor_;
  std::optional<EditingNetworks> readers_;
  std::optional<PerceptualFeatures> features_;
};

}  // namespace partwise
