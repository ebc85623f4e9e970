// A network that reads normals off a picture of an object, of either architecture, and its weights in a file.
//
//   multi_branch  four scales, each of which sees the picture (Fig. 4.1; learning/normal_network.h)
//   u             down to a 32nd of the size and up again (Fig. 4.2; u_network.h)
//
// Shapes: as those of NormalNetwork: pictures B x 4 x S x S (colours as they are shown, and the mask), result
// B x 3 x S x S, unit vectors, zero off the mask. The multi-branch one takes pictures of the size it was made for, the
// other any that 32 divides. Errors: CheckFailed for other shapes; those of reading weights; InputError for weights of
// another kind or other settings.
#pragma once

#include <filesystem>
#include <memory>

#include "partwise/learning/checkpoint.h"
#include "partwise/learning/normal_network.h"
#include "partwise/normals/prediction/u_network.h"

namespace partwise {

enum class NormalArchitecture { multi_branch, u };

struct NormalPredictorSettings {
  NormalArchitecture architecture = NormalArchitecture::u;
  int size = 128;        // of the pictures that it learns from
  int channels = 16;     // NormalNetworkSettings::channels or UNetworkSettings::channels
  double dropout = 0.2;  // of fully connected layers, which the multi-branch one has
};

class NormalPredictor {
 public:
  explicit NormalPredictor(const NormalPredictorSettings& settings);
  explicit NormalPredictor(const NormalNetwork& network);

  at::Tensor operator()(const at::Tensor& pictures) const;

  // The mean of what it finds on each picture and on its mirror image, whose normals are mirrored back: two guesses at
  // the same surface, and their mean is nearer to it. Takes twice as long.
  at::Tensor both_ways(const at::Tensor& pictures) const;

  const NormalPredictorSettings& settings() const;
  torch::nn::Module& module() const;
  std::shared_ptr<torch::nn::Module> shared_module() const;  // to be part of another
  WeightsFile weights() const;

 private:
  struct Network;
  std::shared_ptr<const Network> network_;
};

// Of a weights file of such a network, or of the networks of editing or of scenes: then that of their normals.
NormalPredictor read_normal_predictor(const std::filesystem::path& path);

// The same for whole pictures of scenes, of any size. Errors: InputError for a network that takes one size as well.
NormalPredictor read_scene_predictor(const std::filesystem::path& path);

// The same into one that is there already, of the same architecture and width, and, where it matters, size.
void read_normal_weights(const std::filesystem::path& path, const NormalPredictor& predictor);

}  // namespace partwise
