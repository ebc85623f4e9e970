#include "partwise/learning/training_task.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

namespace partwise {

void Losses::add(const std::string& name, double weight, const at::Tensor& rows) {
  const at::Tensor mean = rows.mean();
  terms.emplace_back(name, mean.item<double>());
  total = total.defined() ? total + weight * mean : weight * mean;
}

}  // namespace partwise
