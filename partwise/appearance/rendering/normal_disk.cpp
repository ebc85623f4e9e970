#include "partwise/appearance/rendering/normal_disk.h"

namespace partwise {

DiskTexels disk_texels(int size) {
  DiskTexels texels;
  const double spacing = 2.0 / disk_steps(size), reach = 1 + 2 * std::sqrt(2.0) * spacing;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = spacing * (column - disk_margin) - 1, y = 1 - spacing * (row - disk_margin),
                   square = x * x + y * y;
      if (square > reach * reach || square >= 2) continue;
      const double scale = std::sqrt(2 - square);
      texels.index.push_back(row * size + column);
      texels.normals.emplace_back(x * scale, y * scale, 1 - square);
    }
  }
  return texels;
}

}  // namespace partwise
