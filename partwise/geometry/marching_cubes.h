// The closed surface between inside and outside of samples on a grid, by marching cubes; see hull_contour.h.
#pragma once

#include <array>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

// Sample (i, j, k) lies at low + spacing (i, j, k) and is values[(k size[1] + j) size[0] + i].
struct SampleGrid {
  std::array<int, 3> size{};
  Point low = Point::Zero();
  double spacing = 1;
  std::vector<float> values;  // inside where negative; positive on the whole border of the grid

  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
};

// Which samples can be reached from the border along the grid's lines without passing an inside sample. With `seal`, a
// length, what can be reached only through gaps, where values are nowhere above seal, is left out, but for the first
// two seals of the way.
std::vector<bool> reached_from_outside(const SampleGrid& grid, double seal = 0);

// Makes inside what is not reached.
void fill_hollows(SampleGrid& grid, double seal = 0);

// Crossings are interpolated along the grid's lines and keep 1/20 spacing from the samples.
Mesh marching_cubes(const SampleGrid& grid);

}  // namespace partwise
