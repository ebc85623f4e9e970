// Fields of errors as sums of levels. What networks get wrong about normals and light is no noise: it hangs together
// over wide regions, and most of all a map of light is too bright or too dark as a whole. So a field is a sum of levels
// of 1, 2, 4, 8, ... rows, enlarged (bilinearly) to its size; a level's values are in units of its standard deviation.
// The sum of their squares says how unlikely a field is, and following its gradient changes wide regions first.
//
// Shapes: fields 1 x 3 x rows x columns, levels 1 x 3 x 2^k x 2^k columns / rows.
#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>
#include <span>
#include <vector>

namespace partwise {

class ErrorLevels {
 public:
  // deviations[k] is that of the level of 2^k rows; those with more rows than the field are left out. `wraps`: columns
  // do, as a map's around the viewer.
  ErrorLevels(std::int64_t rows, std::int64_t columns, std::span<const double> deviations, bool wraps);

  std::vector<at::Tensor>& levels() { return levels_; }  // zero at first

  at::Tensor field() const;
  at::Tensor square() const;  // sum over all levels

 private:
  std::int64_t rows_, columns_;
  std::vector<double> deviations_;
  bool wraps_;
  std::vector<at::Tensor> levels_;
};

// Of a field where the mask (1 x 1 x rows x columns) is 1, the deviation of what each level of 2^k rows adds to the one
// before. Rows are a power of two.
std::vector<double> level_deviations(const at::Tensor& field, const at::Tensor& mask);

}  // namespace partwise
