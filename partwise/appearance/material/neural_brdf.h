// Materials as small networks: Neural-BRDF (Sztrajman, Rainer, Ritschel, Weyrich 2021, "Neural BRDF representation and
// importance sampling"), of which there is one for each material of the MERL database.
//
// The input is six numbers, two unit vectors: the half-vector h = (sin theta_h, 0, cos theta_h) and d, the direction to
// the light turned by -theta_h about y, so that h becomes +z. Three dense layers, ReLU after the first two; the
// value is exp(x) - 1 of what the last one gives, linear RGB in 1/sr without the cosine. Negative values count as zero.
// Files (.h5) are what Keras writes: for each layer, in the order of their names, a matrix kernel:0 (inputs x outputs)
// and a vector bias:0.
//
// Errors: InputError for a file that cannot be read, is no HDF5 file, or holds another network.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/appearance/material/brdf.h"

namespace partwise {

class NeuralBrdf final : public Brdf {
 public:
  static constexpr int widest = 64;
  struct Layer {
    Eigen::MatrixXf weights;  // outputs x inputs
    Eigen::VectorXf bias;
  };

  // Errors: CheckFailed unless three layers fit together, from 6 inputs to 3 outputs, none wider than `widest`.
  explicit NeuralBrdf(std::vector<Layer> layers);

  Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const override;

 private:
  std::vector<Layer> layers_;
};

NeuralBrdf read_neural_brdf(const std::filesystem::path& path);
// The same of bytes that are in memory; messages call them `file`.
NeuralBrdf decode_neural_brdf(const std::string& file, std::string_view bytes);

}  // namespace partwise
