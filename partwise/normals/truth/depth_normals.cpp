#include "partwise/normals/truth/depth_normals.h"

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/normals/truth/surface_runs.h"

namespace partwise {
namespace {

constexpr double radians = std::numbers::pi / 180;
constexpr double differences_that_mean_nothing = 4;  // standard deviations of the inverse depth
constexpr double least_spread = 1e-6;                // of a window's determinant a pixel squared: else all on one line

// Sums over pixels of a row, x and w counted from its beginning: number, x, x^2, w, x w. Those without w are whole
// numbers, so exact.
struct RowSums {
  double n = 0, x = 0, xx = 0, w = 0, xw = 0;
};

// Sums over a window, x and y counted from its middle.
struct WindowSums {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0, w = 0, xw = 0, yw = 0;

  void add(const RowSums& before, const RowSums& last, int column, int dy) {
    const double count = last.n - before.n, row_x = last.x - before.x, row_w = last.w - before.w;
    const double dx = row_x - count * column;
    n += count;
    x += dx;
    y += count * dy;
    xx += last.xx - before.xx - 2 * column * row_x + count * column * column;
    xy += dx * dy;
    yy += count * dy * dy;
    w += row_w;
    xw += last.xw - before.xw - column * row_w;
    yw += row_w * dy;
  }
};

struct Fit {
  Eigen::Vector3d normal;  // of unit length
  double error = 0;        // expected, radians
};

class PlaneFits {
 public:
  PlaneFits(const Image& depth, const PinholeCamera& camera, const DepthNormalSettings& settings)
      : width_(depth.width),
        height_(depth.height),
        camera_(camera),
        settings_(settings),
        inverse_(inverse_depths(depth)),
        runs_(picture_runs(inverse_, width_, height_, limits(camera.focal_x), limits(camera.focal_y))) {
    sums_.resize(inverse_.size() + static_cast<std::size_t>(height_));
    tbb::parallel_for(0, height_, [&](int y) { add_up_row(y); });
  }

  // The normal of the first window, from the smallest, that is good enough.
  std::optional<Eigen::Vector3d> normal(int x, int y) const {
    if (inverse_[at(x, y)] == 0) return std::nullopt;
    std::optional<Fit> best;
    for (int radius = settings_.least_radius; radius <= settings_.most_radius; ++radius) {
      const std::optional<Fit> found = fit(x, y, window(x, y, radius));
      if (found && (!best || found->error < best->error)) best = found;
      if (best && best->error <= settings_.wanted_error * radians) break;
    }
    if (!best || best->error > settings_.most_error * radians) return std::nullopt;
    return best->normal;
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x; }
  // Of the pixels of row y before column x.
  std::size_t sum_at(int x, int y) const { return at(x, y) + static_cast<std::size_t>(y); }

  RunLimits limits(double focal) const {
    RunLimits limits = run_limits(focal, settings_.steepest);
    limits.noise = differences_that_mean_nothing * settings_.noise;
    limits.widest_gap = settings_.widest_gap;
    return limits;
  }

  void add_up_row(int y) {
    for (int x = 0; x < width_; ++x) {
      RowSums sum = sums_[sum_at(x, y)];
      if (const double w = inverse_[at(x, y)]; w != 0) {
        sum.n += 1, sum.x += x, sum.xx += static_cast<double>(x) * x, sum.w += w, sum.xw += x * w;
      }
      sums_[sum_at(x + 1, y)] = sum;
    }
  }

  WindowSums window(int x, int y, int radius) const {
    WindowSums sums;
    const Run column = runs_.columns[at(x, y)];
    for (int row = std::max(column.first, y - radius); row <= std::min(column.last, y + radius); ++row) {
      if (inverse_[at(x, row)] == 0) continue;
      const Run run = runs_.rows[at(x, row)];
      const int first = std::max(run.first, x - radius), last = std::min(run.last, x + radius);
      sums.add(sums_[sum_at(first, row)], sums_[sum_at(last + 1, row)], x, row - y);
    }
    return sums;
  }

  std::optional<Fit> fit(int x, int y, const WindowSums& sums) const {
    if (sums.n < settings_.least_pixels) return std::nullopt;
    const double mean_x = sums.x / sums.n, mean_y = sums.y / sums.n;
    const double xx = sums.xx - mean_x * sums.x, xy = sums.xy - mean_x * sums.y, yy = sums.yy - mean_y * sums.y;
    const double xw = sums.xw - mean_x * sums.w, yw = sums.yw - mean_y * sums.w;
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > least_spread * sums.n * sums.n)) return std::nullopt;
    const double along_x = (xw * yy - yw * xy) / determinant, along_y = (yw * xx - xw * xy) / determinant;
    const double here = sums.w / sums.n - along_x * mean_x - along_y * mean_y;
    if (!(here > 0)) return std::nullopt;
    // To rays, whose v runs up; then along the ray of the pixel to that of the picture's centre.
    const double a = along_x * camera_.focal_x, b = -along_y * camera_.focal_y;
    const Eigen::Vector3d ray = camera_.ray(x, y);
    const Eigen::Vector3d normal(-a, -b, here - a * ray.x() - b * ray.y());
    const double variance = settings_.noise * settings_.noise / determinant *
                            (camera_.focal_x * camera_.focal_x * yy + camera_.focal_y * camera_.focal_y * xx);
    const double length = normal.norm();
    return Fit{normal / length, std::sqrt(variance) / length};
  }

  int width_, height_;
  PinholeCamera camera_;
  DepthNormalSettings settings_;
  std::vector<double> inverse_;  // 1/m, 0 where missing
  PictureRuns runs_;
  std::vector<RowSums> sums_;
};

void check(const Image& depth, const PinholeCamera& camera, const DepthNormalSettings& settings) {
  PARTWISE_CHECK(depth.channels, ==, 1);
  PARTWISE_CHECK(camera.focal_x, >, 0);
  PARTWISE_CHECK(camera.focal_y, >, 0);
  PARTWISE_CHECK(settings.noise, >=, 0);
  PARTWISE_CHECK(settings.least_radius, >=, 1);
  PARTWISE_CHECK(settings.most_radius, >=, settings.least_radius);
  PARTWISE_CHECK(settings.most_radius, <=, 100);
  PARTWISE_CHECK(settings.least_pixels, >=, 3);
  PARTWISE_CHECK(settings.steepest, >, 0);
  PARTWISE_CHECK(settings.steepest, <, 90);
  PARTWISE_CHECK(settings.widest_gap, >=, 0);
}

}  // namespace

Image normals_from_depth(const Image& depth, const PinholeCamera& camera, const DepthNormalSettings& settings,
                         const Progress& progress) {
  check(depth, camera, settings);
  const PlaneFits fits(depth, camera, settings);
  Image normals(depth.width, depth.height, 3);
  SharedProgress rows_done(progress, "normals", depth.height);
  tbb::parallel_for(0, depth.height, [&](int y) {
    for (int x = 0; x < depth.width; ++x) {
      if (const auto normal = fits.normal(x, y)) {
        for (int k = 0; k < 3; ++k) normals.pixel(x, y)[k] = static_cast<float>((*normal)[k]);
      }
    }
    rows_done.add(1);
  });
  return normals;
}

Mask known_normals(const Image& normals) {
  PARTWISE_CHECK(normals.channels, ==, 3);
  Mask known(normals.width, normals.height, 1);
  for (std::size_t i = 0; i < known.values.size(); ++i) {
    const float* n = normals.values.data() + 3 * i;
    known.values[i] = n[0] != 0 || n[1] != 0 || n[2] != 0 ? 1 : 0;
  }
  return known;
}

}  // namespace partwise
