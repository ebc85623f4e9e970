// Training of networks that read normals off a picture of a scene, by normals that a depth sensor measured (scene_
// frames.h): these alone (dissertation, 4.1), or what the picture would look like as well (4.2, section 4.3).
//
//   normal    mean of |n - n'|^2 over the pixels whose depth tells a normal, from 0 to 4
//   pixel     mean of (I - I')^2 over all pixels and channels, of display values, none above white
//   material  mean of (psi - psi')^2 over pixels and components, where the material is known
//   light     mean of the squared error of the logarithm of radiance, over the sphere, where the light is known
//
// I' is what the rendering layer of coefficient images (learning/coefficient_images.h) makes of normals, material and
// light: all three as the networks read them, or, with `given`, the true material and light under the normals that were
// read. Pixels without a measured normal have a say in `pixel`: that is what (4.2) can teach where the sensor fails.
// The layer sees every second pixel of every second row, beginning with another one each step.
//
// Of each stage a term has a weight; one whose weight is 0 is not computed. Weights as those of normal_task.h.
#pragma once

#include <cstdint>
#include <vector>

#include "partwise/editing/sampled_task.h"
#include "partwise/learning/coefficient_images.h"
#include "partwise/learning/training_task.h"
#include "partwise/normals/prediction/scene_frames.h"
#include "partwise/normals/prediction/scene_networks.h"

namespace partwise {

struct SceneTaskSettings {
  std::vector<EditingWeights> stages;
  bool given = false;
  std::int64_t validation_batches = 8;
  std::uint64_t seed = 0;
};

class SceneTask final : public TrainingTask {
 public:
  // The frames must outlive this. Errors: CheckFailed where neither material and light are given nor the networks read
  // them and a stage asks what the picture would look like.
  SceneTask(SceneNetworks networks, const SceneFrames& training, const SceneFrames& validation,
            const SceneTaskSettings& settings);

  torch::nn::Module& network() override { return networks_.module(); }
  WeightsFile weights() const override { return networks_.weights(); }
  Losses training_losses(std::int64_t step, int stage, const Rows& rows) override;
  Losses validation_losses(std::int64_t batch, int stage, const Rows& rows) override;
  std::int64_t validation_batches() const override { return settings_.validation_batches; }

 private:
  struct Lattice {
    std::int64_t x = 0, y = 0;
  };
  Losses losses(const SceneBatch& batch, const EditingWeights& weights, const Lattice& lattice) const;
  void add_picture_terms(const SceneBatch& batch, const at::Tensor& normals, const EditingWeights& weights,
                         const Lattice& lattice, Losses& result) const;

  SceneNetworks networks_;
  const SceneFrames& training_;
  const SceneFrames& validation_;
  SceneTaskSettings settings_;
  CoefficientBasis basis_;
};

}  // namespace partwise
