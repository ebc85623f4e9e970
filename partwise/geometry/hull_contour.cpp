#include "partwise/geometry/hull_contour.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/marching_cubes.h"

namespace partwise {
namespace {

using Planes = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;

constexpr int block = 8;  // samples along a side of the blocks that are looked at as one

// The facet planes, and the planes of support in the directions of a cube's corners, edges and faces.
Planes bevelled_planes(const Mesh& hull) {
  const Planes facets = hull_planes(hull);
  Planes planes(facets.rows() + 26, 4);
  planes.topRows(facets.rows()) = facets;
  Eigen::Index row = facets.rows();
  for (int direction = 0; direction < 27; ++direction) {
    const Eigen::Vector3d sides(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
    if (sides.isZero()) continue;
    const Eigen::Vector3d normal = sides.normalized();
    planes.row(row++) << normal.transpose(), (hull.vertices * normal).maxCoeff();
  }
  return planes;
}

double distance(const Planes& planes, const Point& p) {
  return (planes.leftCols<3>() * p.transpose() - planes.col(3)).maxCoeff();
}

// Samples the distance, less `level`, in the block whose first sample is `low`. Where the distance is above `farthest`
// it may be left larger than it is; deep inside only the sign is kept.
void sample_block(const std::vector<Planes>& hulls, double level, double farthest, const std::array<int, 3>& low,
                  SampleGrid& grid) {
  std::array<int, 3> high;
  for (std::size_t axis = 0; axis < 3; ++axis) high[axis] = std::min(low[axis] + block, grid.size[axis]);
  const double half = grid.spacing * (block - 1) / 2, radius = std::sqrt(3.0) * half;
  const Point first = grid.low + grid.spacing * Point(low[0], low[1], low[2]);
  const Point centre = first + Point::Constant(half);
  const auto for_samples = [&](const auto& visit) {
    for (int k = low[2]; k < high[2]; ++k)
      for (int j = low[1]; j < high[1]; ++j)
        for (int i = low[0]; i < high[0]; ++i) {
          visit(grid.values[grid.index(i, j, k)],
                Point(first + grid.spacing * Point(i - low[0], j - low[1], k - low[2])));
        }
  };
  for (const Planes& planes : hulls) {
    const Eigen::VectorXd at_centre = planes.leftCols<3>() * centre.transpose() - planes.col(3);
    const double middle = at_centre.maxCoeff();
    if (middle - radius > farthest) continue;
    if (middle + radius < level - 2 * grid.spacing) {
      for_samples([&](float& value, const Point&) { value = std::min(value, static_cast<float>(-grid.spacing)); });
      continue;
    }
    std::vector<Eigen::Index> near;  // No other plane is the farthest anywhere in the block.
    for (Eigen::Index n = 0; n < planes.rows(); ++n)
      if (at_centre[n] >= middle - 2 * radius) near.push_back(n);
    const Planes active = planes(near, Eigen::all);
    for_samples([&](float& value, const Point& p) {
      value = std::min(value, static_cast<float>(distance(active, p) - level));
    });
  }
}

SampleGrid sampled(std::span<const Mesh> hulls, const ContourSettings& settings) {
  const double level = settings.distance, spacing = settings.spacing, seal = std::max(settings.seal, settings.doubt);
  Point low = hulls[0].vertices.colwise().minCoeff(), high = hulls[0].vertices.colwise().maxCoeff();
  for (const Mesh& hull : hulls) {
    low = low.cwiseMin(hull.vertices.colwise().minCoeff());
    high = high.cwiseMax(hull.vertices.colwise().maxCoeff());
  }
  SampleGrid grid;
  grid.spacing = spacing;
  const double margin = level + seal + 2 * spacing;
  grid.low = low - Point::Constant(margin);
  const Point cells = (high - low + Point::Constant(2 * margin)) / spacing;
  if (!((cells.array() + 2).prod() <= 134217728.0)) {
    throw InputError("spacing", fmt::format("{} needs more than 2^27 samples", spacing), "ask for a coarser one");
  }
  std::array<int, 3> blocks;
  for (int axis = 0; axis < 3; ++axis) {
    grid.size[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(cells[axis])) + 1;
    blocks[static_cast<std::size_t>(axis)] = (grid.size[static_cast<std::size_t>(axis)] + block - 1) / block;
  }
  grid.values.assign(grid.index(0, 0, grid.size[2]), std::numeric_limits<float>::max());
  std::vector<Planes> planes;
  for (const Mesh& hull : hulls) planes.push_back(bevelled_planes(hull));
  tbb::parallel_for(0, blocks[0] * blocks[1] * blocks[2], [&](int b) {
    const std::array<int, 3> first{b % blocks[0] * block, b / blocks[0] % blocks[1] * block,
                                   b / blocks[0] / blocks[1] * block};
    sample_block(planes, level, level + seal + 2 * spacing, first, grid);
  });
  return grid;
}

// Makes inside what lies between the hulls and is solid; see ContourSettings.
void fill_solid(SampleGrid& grid, const ContourSettings& settings) {
  const std::vector<bool> outside = reached_from_outside(grid, settings.doubt);
  std::vector<char> solid(grid.values.size());
  tbb::parallel_for(0, grid.size[2], [&](int k) {
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t index = grid.index(i, j, k);
        if (outside[index]) continue;
        solid[index] = grid.values[index] < 0 || settings.is_solid(grid.low + grid.spacing * Point(i, j, k));
      }
  });
  const std::size_t steps[] = {grid.index(1, 0, 0), grid.index(0, 1, 0), grid.index(0, 0, 1)};
  for (std::size_t index = steps[2]; index + steps[2] < solid.size(); ++index) {
    if (outside[index] || grid.values[index] < 0) continue;
    int votes = solid[index];
    for (const std::size_t step : steps) votes += solid[index - step] + solid[index + step];
    if (votes >= 4) grid.values[index] = -1e-6f;
  }
}

}  // namespace

Mesh hull_contour(std::span<const Mesh> hulls, const ContourSettings& settings) {
  if (hulls.empty()) throw InputError("hulls", "there are none", "give at least one");
  for (const auto& [name, length] :
       {std::pair("distance", settings.distance), std::pair("spacing", settings.spacing)}) {
    if (!(length > 0 && std::isfinite(length)))
      throw InputError(name, fmt::format("{} is not a length", length), "give a positive number");
  }
  for (const auto& [name, length] : {std::pair("seal", settings.seal), std::pair("doubt", settings.doubt)}) {
    if (!(length >= 0 && std::isfinite(length)))
      throw InputError(name, fmt::format("{} is not a length", length), "give 0 or a positive number");
  }
  SampleGrid grid = sampled(hulls, settings);
  if (settings.is_solid) fill_solid(grid, settings);
  fill_hollows(grid, settings.seal);
  return marching_cubes(grid);
}

}  // namespace partwise
