// Layers that the networks of this project are made of. Internal to the rooms that have networks: it names torch/nn,
// which takes long to compile.
//
// Where it is said, activations are normalised over groups of eight channels of each sample (Wu and He 2018, "Group
// normalization"), not over a batch: a sample's result then does not depend on its neighbours, and a batch may be
// shared between processes. On the way in, normalisation takes from a picture how bright it is and of what colour:
// shape does not need that, material and light are little else.
#pragma once

#include <torch/nn/modules/container/sequential.h>
#include <torch/nn/modules/conv.h>
#include <torch/nn/modules/linear.h>

#include <vector>

#include "partwise/learning/rows.h"

namespace partwise {

// Dropout whose mask is drawn for all rows of a batch that processes share, of which this one takes its own.
class RowDropoutImpl : public torch::nn::Module {
 public:
  explicit RowDropoutImpl(double share) : share_(share) {}
  at::Tensor forward(const at::Tensor& values);  // B x n
  void take(const Rows& rows) { rows_ = rows; }

 private:
  double share_;
  Rows rows_;
};
TORCH_MODULE(RowDropout);

// Tells every RowDropout of a network which rows come next.
void take_rows(torch::nn::Module& network, const Rows& rows);

// Convolution, its size kept but for the stride; normalisation; rectifier.
torch::nn::Sequential convolution(int from, int to, int kernel = 3, int stride = 1);
// Convolution that halves the size; rectifier.
torch::nn::Sequential halving_convolution(int from, int to, int kernel);
// Convolutions that each halve the size, with normalisation or without, the first of 5 x 5 and from `from` channels,
// the others of 3 x 3.
enum class Normalisation { none, groups };
torch::nn::Sequential halving_convolutions(int from, const std::vector<int>& channels, Normalisation normalisation);
// Transposed convolution that doubles the size; normalisation; rectifier.
torch::nn::Sequential doubling_convolution(int from, int to);
// Vectors of a map, B x 3 x H x W, brought to unit length.
at::Tensor unit_vectors(const at::Tensor& vectors);
// Fully connected; rectifier; dropout.
torch::nn::Sequential connected(int from, int to, double dropout);

}  // namespace partwise
