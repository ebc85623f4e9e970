#include "partwise/geometry/contours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/geometry/orientation.h"

namespace partwise {
namespace {

// The grid with a border of empty samples. A cell has samples (x, y) .. (x + 1, y + 1) of it.
class Grid {
 public:
  Grid(std::span<const float> values, int width, int height, float level)
      : width_(width + 2), height_(height + 2), level_(level), values_(static_cast<std::size_t>(width_) * height_) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const float value = values[static_cast<std::size_t>(y) * width + x];
        if (std::isfinite(value)) values_[index(x + 1, y + 1)] = value;
      }
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  bool filled(int x, int y) const { return values_[index(x, y)] > level_; }

  // Where the level is crossed between two samples that differ.
  Point2 crossing(int x0, int y0, int x1, int y1) const {
    const double a = values_[index(x0, y0)], b = values_[index(x1, y1)];
    const double t = std::clamp((level_ - a) / (b - a), 1e-3, 1 - 1e-3);
    return {x0 - 0.5 + t * (x1 - x0), y0 - 0.5 + t * (y1 - y0)};
  }

  bool saddle_filled(int x, int y) const {
    return (static_cast<double>(values_[index(x, y)]) + values_[index(x + 1, y)] + values_[index(x, y + 1)] +
            values_[index(x + 1, y + 1)]) /
               4 >
           level_;
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

 private:
  int width_, height_;
  float level_;
  std::vector<float> values_;
};

// The sides of a cell, in the order in which they follow each other: top, right, bottom, left.
constexpr std::array<std::array<int, 2>, 4> corner_of_side{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

}  // namespace

Polygons trace_contours(std::span<const float> values, int width, int height, float level) {
  PARTWISE_CHECK(level, >, 0);
  PARTWISE_CHECK(values.size(), ==, static_cast<std::size_t>(width) * height);
  const Grid grid(values, width, height, level);
  // A contour enters a cell where, going round it from corner to corner, filled turns to empty, and leaves it where
  // empty turns to filled: what is filled is then always on the same hand.
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(grid.width()) * grid.height());
  const auto at = [&](int x, int y, int corner) {
    return grid.filled(x + corner_of_side[corner & 3][0], y + corner_of_side[corner & 3][1]);
  };
  const auto enters = [&](int x, int y, int side) { return at(x, y, side) && !at(x, y, side + 1); };
  const auto leaves = [&](int x, int y, int side) { return !at(x, y, side) && at(x, y, side + 1); };
  std::vector<Ring> rings;
  for (int start_y = 0; start_y + 1 < grid.height(); ++start_y) {
    for (int start_x = 0; start_x + 1 < grid.width(); ++start_x) {
      for (int start_side = 0; start_side < 4; ++start_side) {
        int x = start_x, y = start_y, side = start_side;
        if (!enters(x, y, side) || (seen[grid.index(x, y)] & (1 << side))) continue;
        std::vector<Point2> corners;
        while (!(seen[grid.index(x, y)] & (1 << side))) {
          seen[grid.index(x, y)] |= static_cast<std::uint8_t>(1 << side);
          const auto& a = corner_of_side[side];
          const auto& b = corner_of_side[(side + 1) & 3];
          corners.push_back(grid.crossing(x + a[0], y + a[1], x + b[0], y + b[1]));
          // With two ways out, a filled saddle keeps to the empty corner that was met, an empty one to the filled.
          int out = side;
          if (grid.saddle_filled(x, y)) {
            do out = (out + 1) & 3;
            while (!leaves(x, y, out));
          } else {
            do out = (out + 3) & 3;
            while (!leaves(x, y, out));
          }
          x += out == 1 ? 1 : out == 3 ? -1 : 0;
          y += out == 2 ? 1 : out == 0 ? -1 : 0;
          side = (out + 2) & 3;
        }
        Ring ring(static_cast<Eigen::Index>(corners.size()), 2);
        for (std::size_t i = 0; i < corners.size(); ++i)
          ring.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
        rings.push_back(std::move(ring));
      }
    }
  }
  return assemble_polygons(std::move(rings), FillRule::even_odd);
}

}  // namespace partwise
