// Where the samples of a pixel lie. Internal to this room.
#pragma once

#include <Eigen/Core>

namespace partwise {

// In [0, 1]^2 from the pixel's top left: Hammersley's set, moved into the middle of its cells.
inline Eigen::Vector2d sample_place(int index, int count) {
  double reversed = 0, digit = 0.5;
  int cells = 1;
  while (cells < count) cells *= 2;
  for (int i = index; i > 0; i /= 2, digit /= 2) reversed += (i & 1) * digit;
  return {(index + 0.5) / count, reversed + 0.5 / cells};
}

}  // namespace partwise
