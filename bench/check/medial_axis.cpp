#include "bench/check/medial_axis.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <utility>

namespace partwise::bench {
namespace {

using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using Neighbours = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

constexpr double kOverlap = 0.02;   // of the radius: how far a ball may reach through the surface
constexpr double kRounding = 1e-6;  // of the radius: by which a centre may miss its four samples

struct SurfaceSample {
  std::vector<std::pair<Point, int>> points;  // and their numbers
  std::vector<Vector> outwards;               // of the face of each
};

// Even in [0, 1), the same for every standard library.
double even(std::mt19937_64& random) { return static_cast<double>(random() >> 11U) * 0x1p-53; }

Vector cross(const Shape& shape, const std::array<int, 3>& face) {
  const Point& a = shape.vertices[face[0]];
  return CGAL::cross_product(shape.vertices[face[1]] - a, shape.vertices[face[2]] - a);
}

// By area: the same area belongs to every sample, and one is drawn from it.
SurfaceSample sample_surface(const Shape& shape, const MedialAxisSettings& settings) {
  double area = 0;
  for (const auto& face : shape.faces) area += std::sqrt(cross(shape, face).squared_length()) / 2;
  const double share = area / settings.samples;
  std::mt19937_64 random(settings.seed);
  SurfaceSample sample;
  double passed = 0, next = share * even(random);
  for (const auto& face : shape.faces) {
    const Vector normal = cross(shape, face);
    passed += std::sqrt(normal.squared_length()) / 2;
    const Point& a = shape.vertices[face[0]];
    for (; next < passed; next = share * (static_cast<double>(sample.outwards.size()) + even(random))) {
      const double root = std::sqrt(even(random)), other = even(random);
      const Point at =
          a + root * (1 - other) * (shape.vertices[face[1]] - a) + root * other * (shape.vertices[face[2]] - a);
      sample.points.emplace_back(at, static_cast<int>(sample.outwards.size()));
      sample.outwards.push_back(normal);
    }
  }
  return sample;
}

// The cosine of the widest angle between two corners of a cell, seen from its centre.
double least_cosine(const Delaunay::Cell_handle cell, const Point& centre, double square) {
  double least = 1;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      least = std::min(least, (cell->vertex(i)->point() - centre) * (cell->vertex(j)->point() - centre) / square);
  return least;
}

// Rounding makes nonsense of the centre of a cell that is nearly flat.
bool is_centre(const Delaunay::Cell_handle cell, const Point& centre, double square) {
  for (int k = 0; k < 4; ++k) {
    const double other = CGAL::squared_distance(cell->vertex(k)->point(), centre);
    if (std::abs(other - square) > kRounding * square) return false;
  }
  return true;
}

// The farthest Voronoi vertex of p's cell on the inner side, if it is of the axis.
std::optional<Point> inner_pole(const Point& p, const Vector& outwards, const std::vector<Delaunay::Cell_handle>& cells,
                                const Delaunay& delaunay, const Solid& solid, double largest_cosine) {
  Delaunay::Cell_handle farthest;
  Point pole;
  double square = 0;
  for (const Delaunay::Cell_handle cell : cells) {
    if (delaunay.is_infinite(cell)) continue;
    const Point centre = delaunay.dual(cell);
    const double other = CGAL::squared_distance(p, centre);
    if ((centre - p) * outwards >= 0 || other <= square || !is_centre(cell, centre, other)) continue;
    farthest = cell;
    pole = centre;
    square = other;
  }
  if (square == 0 || least_cosine(farthest, pole, square) > largest_cosine) return std::nullopt;
  if (solid.distance(pole) < (1 - kOverlap) * std::sqrt(square)) return std::nullopt;
  return pole;
}

}  // namespace

std::vector<Point> medial_axis(const Shape& shape, const Solid& solid, const MedialAxisSettings& settings) {
  const SurfaceSample sample = sample_surface(shape, settings);
  const Delaunay delaunay(sample.points.begin(), sample.points.end());
  const double largest_cosine = std::cos(settings.least_angle * std::numbers::pi / 180);
  std::vector<Point> axis;
  std::vector<Delaunay::Cell_handle> cells;
  for (const auto vertex : delaunay.finite_vertex_handles()) {
    cells.clear();
    delaunay.incident_cells(vertex, std::back_inserter(cells));
    const Vector& outwards = sample.outwards[static_cast<std::size_t>(vertex->info())];
    if (const auto pole = inner_pole(vertex->point(), outwards, cells, delaunay, solid, largest_cosine))
      axis.push_back(*pole);
  }
  return axis;
}

std::vector<double> distances_to_nearest(const std::vector<Point>& from, const std::vector<Point>& to) {
  const Neighbours::Tree tree(to.begin(), to.end());
  std::vector<double> distances;
  for (const Point& p : from) distances.push_back(std::sqrt(Neighbours(tree, p, 1).begin()->second));
  std::sort(distances.begin(), distances.end());
  return distances;
}

}  // namespace partwise::bench
