// The gradients of processes that share a batch, averaged: libtorch's process group over Gloo.
//
// Processes meet at MASTER_ADDR:MASTER_PORT, where the first of them listens. One process alone exchanges nothing.
// Errors: InputError where the variables are missing or the processes do not find each other in c10d's
// time, or one of them is gone.
#pragma once

#include <memory>
#include <vector>

#include "partwise/base/ranks.h"

namespace torch::nn {
class Module;
}

namespace partwise {

class GradientExchange {
 public:
  explicit GradientExchange(const Rank& rank);
  ~GradientExchange();

  // Parameters as the first process has them.
  void share_parameters(torch::nn::Module& network);
  // Gradients become the mean over processes.
  void average_gradients(torch::nn::Module& network);
  // Numbers become the mean over processes.
  void average(std::vector<double>& numbers);

 private:
  struct Group;
  std::unique_ptr<Group> group_;  // none: one process alone
};

}  // namespace partwise
