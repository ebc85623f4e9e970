// What a training loop trains: a network, and what it is to become good at.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "partwise/learning/checkpoint.h"
#include "partwise/learning/rows.h"

namespace torch::nn {
class Module;
}

namespace partwise {

// Terms of a loss by name, each a number: the mean over the rows of what each row has. `total` is what is minimised.
struct Losses {
  at::Tensor total;
  std::vector<std::pair<std::string, double>> terms;

  // A term, a number a row.
  void add(const std::string& name, double weight, const at::Tensor& rows);
};

class TrainingTask {
 public:
  virtual ~TrainingTask() = default;

  virtual torch::nn::Module& network() = 0;
  // What its weights files say of it.
  virtual WeightsFile weights() const = 0;

  // Of the batch of a step, the same whenever it is asked for. `stage`: of the training's, from 0.
  virtual Losses training_losses(std::int64_t step, int stage, const Rows& rows) = 0;

  // Of a batch that no step trains on. How many there are.
  virtual Losses validation_losses(std::int64_t batch, int stage, const Rows& rows) = 0;
  virtual std::int64_t validation_batches() const = 0;
};

}  // namespace partwise
