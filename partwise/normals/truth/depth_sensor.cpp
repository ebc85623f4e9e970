#include "partwise/normals/truth/depth_sensor.h"

#include <tbb/parallel_for.h>
#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/normals/truth/surface_runs.h"

namespace partwise {
namespace {

constexpr double steepest_surface = 85;  // degrees; what is steeper is a step

enum Purpose : std::uint64_t { lateral_draw, shift_draw, edge_draw, grazing_draw, mirror_draw };

// Two numbers of the normal distribution (Box and Muller 1958).
std::array<double, 2> normal_pair(Draw draw) {
  const double radius = std::sqrt(-2 * std::log(1 - draw.unit())), angle = draw.within(0, 2 * std::numbers::pi);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

class Sensing {
 public:
  Sensing(const Image& depth, const Image& normals, const Image* mirrors, const PinholeCamera& camera,
          const DepthSensor& sensor, std::uint64_t seed)
      : width_(depth.width),
        height_(depth.height),
        normals_(normals),
        mirrors_(mirrors),
        camera_(camera),
        sensor_(sensor),
        seed_(seed),
        inverse_(inverse_depths(depth)),
        runs_(picture_runs(inverse_, width_, height_, run_limits(camera.focal_x, steepest_surface),
                           run_limits(camera.focal_y, steepest_surface))) {}

  // A row of the result.
  void sense_row(int y, std::span<float> row) const {
    const std::vector<char> lit = sensor_.shadow ? lit_row(y) : std::vector<char>(row.size(), 1);
    for (int x = 0; x < width_; ++x) {
      if (inverse_[at(x, y)] == 0 || !lit[static_cast<std::size_t>(x)] || is_lost(x, y)) continue;
      const double shift =
          displaced(x, y) / sensor_.step() + sensor_.shift_noise * normal_pair(draw(x, y, shift_draw))[0];
      const double depth = 1 / (sensor_.step() * std::round(shift));
      if (depth >= sensor_.nearest && depth <= sensor_.farthest)
        row[static_cast<std::size_t>(x)] = static_cast<float>(depth);
    }
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x; }
  Draw draw(int x, int y, Purpose purpose) const { return {seed_, at(x, y), purpose}; }

  // From the right, whether the projector sees the pixel: its columns have to fall as well.
  std::vector<char> lit_row(int y) const {
    std::vector<char> lit(static_cast<std::size_t>(width_), 1);
    double least = std::numeric_limits<double>::infinity();
    for (int x = width_ - 1; x >= 0; --x) {
      const double inverse = inverse_[at(x, y)];
      if (inverse == 0) continue;
      const double column = x - camera_.focal_x * sensor_.baseline * inverse;
      lit[static_cast<std::size_t>(x)] = column <= least ? 1 : 0;
      least = std::min(least, column);
    }
    return lit;
  }

  bool is_lost(int x, int y) const {
    if (is_beside_step(x, y) && draw(x, y, edge_draw).unit() < sensor_.edge_loss) return true;
    const double grazing = grazing_share(x, y), mirror = mirrors_ != nullptr ? mirrors_->values[at(x, y)] : 0.0f;
    return (grazing > 0 && patch_value(x, y, grazing_draw) < grazing) ||
           (mirror > 0 && patch_value(x, y, mirror_draw) < mirror);
  }

  bool is_beside_step(int x, int y) const {
    const Run row = runs_.rows[at(x, y)], column = runs_.columns[at(x, y)];
    return (row.first == x && x > 0) || (row.last == x && x + 1 < width_) || (column.first == y && y > 0) ||
           (column.last == y && y + 1 < height_);
  }

  double grazing_share(int x, int y) const {
    const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3f>(normals_.pixel(x, y)).cast<double>();
    const double cosine = -normal.dot(camera_.ray(x, y).normalized());
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
    return std::clamp((angle - sensor_.grazing_from) / (sensor_.grazing_to - sensor_.grazing_from), 0.0, 1.0);
  }

  // Even in [0, 1), the same all over a patch: that of the nearest of points that lie one in each square of a grid.
  double patch_value(int x, int y, Purpose purpose) const {
    const int column = static_cast<int>(x / sensor_.patch), row = static_cast<int>(y / sensor_.patch);
    double least = std::numeric_limits<double>::infinity(), value = 0;
    for (int j = row - 1; j <= row + 1; ++j) {
      for (int i = column - 1; i <= column + 1; ++i) {
        const auto number = static_cast<std::uint64_t>(j + 1) << 32 | static_cast<std::uint64_t>(i + 1);
        Draw draw(seed_, number, purpose);
        const double dx = (i + draw.unit()) * sensor_.patch - x, dy = (j + draw.unit()) * sensor_.patch - y;
        const double square = dx * dx + dy * dy;
        if (square >= least) continue;
        least = square;
        value = draw.unit();
      }
    }
    return value;
  }

  // The inverse depth a little beside the pixel: between four pixels of one surface that of their plane, else that of
  // the nearest of them, so that outlines become ragged.
  double displaced(int x, int y) const {
    const auto [dx, dy] = normal_pair(draw(x, y, lateral_draw));
    const double column = std::clamp(x + sensor_.lateral * dx, 0.0, width_ - 1.0);
    const double row = std::clamp(y + sensor_.lateral * dy, 0.0, height_ - 1.0);
    const int left = std::min(static_cast<int>(column), width_ - 2), top = std::min(static_cast<int>(row), height_ - 2);
    if (left >= 0 && top >= 0 && is_one_surface(left, top)) {
      const double right_share = column - left, low_share = row - top;
      const double upper = std::lerp(inverse_[at(left, top)], inverse_[at(left + 1, top)], right_share);
      const double lower = std::lerp(inverse_[at(left, top + 1)], inverse_[at(left + 1, top + 1)], right_share);
      return std::lerp(upper, lower, low_share);
    }
    const double nearest = inverse_[at(static_cast<int>(std::lround(column)), static_cast<int>(std::lround(row)))];
    return nearest > 0 ? nearest : inverse_[at(x, y)];
  }

  bool is_one_surface(int left, int top) const {
    return runs_.rows[at(left, top)].last > left && runs_.rows[at(left, top + 1)].last > left &&
           runs_.columns[at(left, top)].last > top && runs_.columns[at(left + 1, top)].last > top &&
           inverse_[at(left + 1, top)] > 0 && inverse_[at(left, top + 1)] > 0;
  }

  int width_, height_;
  const Image& normals_;
  const Image* mirrors_;
  PinholeCamera camera_;
  DepthSensor sensor_;
  std::uint64_t seed_;
  std::vector<double> inverse_;  // 1/m, 0 where nothing is
  PictureRuns runs_;
};

void check(const Image& depth, const Image& other, int channels) {
  PARTWISE_CHECK(other.width, ==, depth.width);
  PARTWISE_CHECK(other.height, ==, depth.height);
  PARTWISE_CHECK(other.channels, ==, channels);
}

void check(const DepthSensor& sensor) {
  PARTWISE_CHECK(sensor.step(), >, 0);
  PARTWISE_CHECK(sensor.baseline, >, 0);
  PARTWISE_CHECK(sensor.shift_noise, >=, 0);
  PARTWISE_CHECK(sensor.lateral, >=, 0);
  PARTWISE_CHECK(sensor.grazing_to, >, sensor.grazing_from);
  PARTWISE_CHECK(sensor.nearest, >=, 0);
  PARTWISE_CHECK(sensor.farthest, >, sensor.nearest);
  PARTWISE_CHECK(sensor.patch, >=, 1);
}

Image sense(const Image& depth, const Image& normals, const Image* mirrors, const PinholeCamera& camera,
            const DepthSensor& sensor, std::uint64_t seed) {
  check(depth, depth, 1);
  check(depth, normals, 3);
  if (mirrors != nullptr) check(depth, *mirrors, 1);
  check(sensor);
  PARTWISE_CHECK(camera.focal_x, >, 0);
  PARTWISE_CHECK(camera.focal_y, >, 0);
  const Sensing sensing(depth, normals, mirrors, camera, sensor, seed);
  Image result(depth.width, depth.height, 1);
  tbb::parallel_for(0, depth.height, [&](int y) {
    sensing.sense_row(y, {result.pixel(0, y), static_cast<std::size_t>(depth.width)});
  });
  return result;
}

}  // namespace

Image sensed_depth(const Image& depth, const Image& normals, const Image& mirrors, const PinholeCamera& camera,
                   const DepthSensor& sensor, std::uint64_t seed) {
  return sense(depth, normals, &mirrors, camera, sensor, seed);
}

Image sensed_depth(const Image& depth, const Image& normals, const PinholeCamera& camera, const DepthSensor& sensor,
                   std::uint64_t seed) {
  return sense(depth, normals, nullptr, camera, sensor, seed);
}

}  // namespace partwise
