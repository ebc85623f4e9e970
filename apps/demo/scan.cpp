#include "scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "partwise/geometry/contours.h"

namespace demo {
namespace {

using partwise::Ring;

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// Values in [-1, 1] on a lattice, smooth between: noise of one size.
class ValueNoise {
 public:
  ValueNoise(int width, int height, double spacing, std::mt19937_64& random)
      : spacing_(spacing), columns_(static_cast<int>(width / spacing) + 2) {
    const int rows = static_cast<int>(height / spacing) + 2;
    for (int i = 0; i < columns_ * rows; ++i) values_.push_back(uniform(random, -1, 1));
  }

  double at(double x, double y) const {
    const double u = x / spacing_, v = y / spacing_;
    const int column = static_cast<int>(u), row = static_cast<int>(v);
    const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double s = smooth(u - column), t = smooth(v - row);
    const auto value = [&](int c, int r) {
      return values_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)];
    };
    return (1 - t) * ((1 - s) * value(column, row) + s * value(column + 1, row)) +
           t * ((1 - s) * value(column, row + 1) + s * value(column + 1, row + 1));
  }

 private:
  double spacing_;
  int columns_;
  std::vector<double> values_;
};

// The corners as seen from an azimuth: to the right, and up.
partwise::Ring seen(const partwise::Mesh& mesh, double azimuth) {
  Ring points(mesh.vertices.rows(), 2);
  points.col(0) = std::cos(azimuth) * mesh.vertices.col(0) + std::sin(azimuth) * mesh.vertices.col(2);
  points.col(1) = mesh.vertices.col(1);
  return points;
}

Ring seen_widest(const partwise::Mesh& mesh) {
  Ring best;
  double widest = 0;
  for (int step = 0; step < 36; ++step) {
    Ring points = seen(mesh, step * std::numbers::pi / 36);
    const double width = points.col(0).maxCoeff() - points.col(0).minCoeff();
    if (width > widest) widest = width, best = std::move(points);
  }
  return best;
}

}  // namespace

Scan::Scan(int width, int height)
    : width_(width), height_(height), values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void Scan::paint(std::span<const Ring> rings) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Ring& ring : rings) {
    low = std::min(low, ring.col(1).minCoeff());
    high = std::max(high, ring.col(1).maxCoeff());
  }
  std::vector<double> crossings;
  const int first = std::max(0, static_cast<int>(low)), last = std::min(height_ - 1, static_cast<int>(high));
  for (int row = first; row <= last; ++row) {
    const double y = row + 0.5;
    crossings.clear();
    for (const Ring& ring : rings) {
      for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
        const double y0 = ring(j, 1), y1 = ring(i, 1);
        if ((y0 > y) == (y1 > y)) continue;
        crossings.push_back(ring(j, 0) + (y - y0) / (y1 - y0) * (ring(i, 0) - ring(j, 0)));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil(crossings[k] - 0.5)));
      const int to = std::min(width_ - 1, static_cast<int>(std::floor(crossings[k + 1] - 0.5)));
      for (int column = from; column <= to; ++column) at(column, row) = 1;
    }
  }
}

void Scan::paint_silhouette(const partwise::Mesh& mesh, double x, double y, double height, bool mirrored) {
  Ring points = seen_widest(mesh);
  const Eigen::RowVector2d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  const double scale = height / (high.y() - low.y());
  points.col(0) = x + scale * (mirrored ? -1 : 1) * (points.col(0).array() - (low.x() + high.x()) / 2);
  points.col(1) = y - scale * (points.col(1).array() - low.y());
  std::vector<Ring> triangle(1, Ring(3, 2));
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) triangle[0].row(k) = points.row(mesh.faces(f, k));
    paint(triangle);
  }
}

void Scan::blur(int radius) {
  const auto pass = [&](int length, int lines, std::size_t step, std::size_t line_step) {
    std::vector<float> line(static_cast<std::size_t>(length));
    for (int l = 0; l < lines; ++l) {
      float* const values = values_.data() + static_cast<std::size_t>(l) * line_step;
      for (int i = 0; i < length; ++i) {
        float sum = 0;
        for (int k = std::max(0, i - radius); k <= std::min(length - 1, i + radius); ++k) sum += values[k * step];
        line[i] = sum / static_cast<float>(2 * radius + 1);
      }
      for (int i = 0; i < length; ++i) values[i * step] = line[i];
    }
  };
  pass(width_, height_, 1, static_cast<std::size_t>(width_));
  pass(height_, width_, static_cast<std::size_t>(width_), 1);
}

bool Scan::is_full(double x, double y, double radius) const {
  for (int row = static_cast<int>(y - radius); row <= static_cast<int>(y + radius); ++row) {
    for (int column = static_cast<int>(x - radius); column <= static_cast<int>(x + radius); ++column) {
      if (row < 0 || column < 0 || row >= height_ || column >= width_ || at(column, row) < 0.6f) return false;
    }
  }
  return true;
}

void Scan::roughen(double edge, int specks, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const int radius = std::max(1, static_cast<int>(std::lround(edge)));
  blur(radius);
  blur(radius);
  const ValueNoise fine(width_, height_, 2.5 * radius, random), coarse(width_, height_, 7.0 * radius, random);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      // Full and empty pixels stay what they are: only edges move.
      at(x, y) += static_cast<float>(0.28 * fine.at(x, y) + 0.16 * coarse.at(x, y));
    }
  }
  for (int tries = 0, made = 0; made < specks && tries < 60 * specks; ++tries) {
    const double x = uniform(random, 0, width_), y = uniform(random, 0, height_), r = uniform(random, 2.5, 5);
    if (!is_full(x, y, r + 3)) continue;
    ++made;
    for (int row = static_cast<int>(y - r - 1); row <= static_cast<int>(y + r + 1); ++row) {
      for (int column = static_cast<int>(x - r - 1); column <= static_cast<int>(x + r + 1); ++column) {
        const double inside = r - std::hypot(column + 0.5 - x, row + 0.5 - y);
        at(column, row) -= static_cast<float>(std::clamp(inside + 0.5, 0.0, 1.0));
      }
    }
  }
}

partwise::Polygons Scan::outlines() const {
  partwise::Polygons polygons = partwise::trace_contours(values_, width_, height_);
  std::erase_if(polygons, [](const partwise::Polygon& polygon) { return partwise::area(polygon) < 100; });
  return polygons;
}

}  // namespace demo
