// A noisy version of a shape: its boundary resampled and moved at random, and small holes.
//
//   outline_noise SHAPE OUT.geojson [--seed N] [--jitter 0.005] [--holes 20]
//
// Lengths are shares of R, the radius of the enclosing circle. Corners closer than 0.25 % to a chord go, sides longer
// than 2 % are split, then each corner moves within a disc of radius `jitter`. Holes are star-shaped, of 5 to 9
// corners, with radii from 1 % to 3 %, inside the shape and clear of its boundary and of each other; fewer where no
// more fit.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "partwise/geometry/polygon_validity.h"
#include "partwise/parts/planar/hierarchical_concavity.h"
#include "partwise/parts/planar/read_shape.h"

namespace {

using partwise::Point2;
using partwise::Polygons;
using partwise::Ring;

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

Ring resampled(const Ring& ring, double chord, double side) {
  std::vector<Point2> kept;
  const Eigen::Index n = ring.rows();
  const auto at = [&](Eigen::Index i) -> Point2 { return ring.row(i % n).transpose(); };
  for (Eigen::Index from = 0; from < n;) {
    Eigen::Index to = from + 1;
    for (bool fits = true; fits && to < n;) {
      for (Eigen::Index k = from + 1; k <= to && fits; ++k) {
        fits = partwise::distance_to_segment(at(k), at(from), at(to + 1)) <= chord;
      }
      if (fits) ++to;
    }
    const int pieces = std::max(1, static_cast<int>(std::ceil((at(to) - at(from)).norm() / side)));
    for (int p = 0; p < pieces; ++p) kept.push_back(at(from) + (at(to) - at(from)) * p / pieces);
    from = to;
  }
  Ring result(static_cast<Eigen::Index>(kept.size()), 2);
  for (std::size_t i = 0; i < kept.size(); ++i) result.row(static_cast<Eigen::Index>(i)) = kept[i].transpose();
  return result;
}

void jitter(Ring& ring, double radius, std::mt19937_64& random) {
  for (Eigen::Index i = 0; i < ring.rows(); ++i) {
    const double angle = uniform(random, 0, 2 * std::numbers::pi), length = radius * std::sqrt(uniform(random, 0, 1));
    ring.row(i) += length * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
  }
}

bool encloses(const partwise::Polygon& polygon, const Point2& p, double clearance) {
  bool inside = false;
  const auto visit = [&](const Ring& ring) {
    for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
      const Point2 a = ring.row(j), b = ring.row(i);
      if (partwise::distance_to_segment(p, a, b) < clearance) return false;
      if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) {
        inside = !inside;
      }
    }
    return true;
  };
  if (!visit(polygon.outer)) return false;
  for (const Ring& hole : polygon.holes) {
    if (!visit(hole)) return false;
  }
  return inside;
}

void add_holes(Polygons& shape, int count, double unit, std::mt19937_64& random) {
  for (int tries = 0, made = 0; tries < 200 * count && made < count; ++tries) {
    partwise::Polygon& polygon = shape[random() % shape.size()];
    const Eigen::RowVector2d low = polygon.outer.colwise().minCoeff(), high = polygon.outer.colwise().maxCoeff();
    const Point2 centre(uniform(random, low.x(), high.x()), uniform(random, low.y(), high.y()));
    const double radius = unit * uniform(random, 0.01, 0.03);
    if (!encloses(polygon, centre, 1.2 * radius)) continue;
    const int corners = 5 + static_cast<int>(random() % 5);
    Ring hole(corners, 2);
    for (int i = 0; i < corners; ++i) {
      const double angle = -2 * std::numbers::pi * (i + uniform(random, -0.3, 0.3)) / corners;
      hole.row(i) =
          centre.transpose() + radius * uniform(random, 0.7, 1) * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
    }
    polygon.holes.push_back(hole);
    ++made;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Adds noise to a shape.", "outline_noise");
  std::string shape, out;
  unsigned seed = 0;
  double amount = 0.005;
  int holes = 20;
  program.add_option("SHAPE", shape)->required();
  program.add_option("OUT", out)->required();
  program.add_option("--seed", seed);
  program.add_option("--jitter", amount);
  program.add_option("--holes", holes);
  CLI11_PARSE(program, argc, argv);
  try {
    Polygons polygons = partwise::read_shape(shape, {.lenient = true}).polygons;
    const double unit = partwise::enclosing_circle(polygons).radius;
    std::mt19937_64 random(seed);
    const auto roughen = [&](Ring& ring) {
      ring = resampled(ring, 0.0025 * unit, 0.02 * unit);
      jitter(ring, amount * unit, random);
    };
    for (partwise::Polygon& polygon : polygons) {
      roughen(polygon.outer);
      for (Ring& hole : polygon.holes) roughen(hole);
    }
    partwise::normalise(polygons);
    if (partwise::find_fault(polygons)) polygons = partwise::repair_polygons(polygons, shape);
    std::erase_if(polygons, [&](const auto& polygon) { return partwise::area(polygon) < 1e-4 * unit * unit; });
    add_holes(polygons, holes, unit, random);
    partwise::write_geojson(out, polygons);
  } catch (const std::exception& error) {
    fmt::print(stderr, "outline_noise: {}\n", error.what());
    return 1;
  }
  return 0;
}
