#include "partwise/geometry/union_volume.h"

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// A grid of lines over the plane (s, t), which is the plane across `axis` turned by an angle with a badly approximable
// tangent: straight walls then cross the grid at a slant and the errors of neighbouring rows cancel, so that a box
// that is parallel to the axes is measured as well as any other. Line (i, j) passes through the integer point (i, j).
struct Grid {
  int axis = 2;
  Eigen::Matrix<double, 2, 3> to_plane;  // model to (s, t), in spacings
  Eigen::Vector2d origin;                // (s, t) of line (0, 0)
  int columns = 0, rows = 0;
  double cell = 0;  // area of a line's cell, model units squared

  Grid(std::span<const Mesh* const> meshes, int lines);
};

Grid::Grid(std::span<const Mesh* const> meshes, int lines) {
  if (lines < 1) throw InputError("lines", fmt::format("{} is no number of lines", lines), "ask for 1 or more");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low = Point::Constant(infinity), high = -low;
  for (const Mesh* mesh : meshes) {
    if (mesh->vertices.rows() == 0) continue;
    low = low.cwiseMin(mesh->vertices.colwise().minCoeff());
    high = high.cwiseMax(mesh->vertices.colwise().maxCoeff());
  }
  if (!((high - low).maxCoeff() > 0)) return;
  (high - low).maxCoeff(&axis);
  // tan = (sqrt 5 - 1) / 2, the golden section.
  const double cosine = 1 / std::sqrt(1 + 0.25 * std::pow(std::sqrt(5.0) - 1, 2));
  const double sine = std::sqrt(1 - cosine * cosine);
  const Eigen::RowVector3d x = Eigen::RowVector3d::Unit((axis + 1) % 3), y = Eigen::RowVector3d::Unit((axis + 2) % 3);
  to_plane << cosine * x + sine * y, cosine * y - sine * x;
  Eigen::Vector2d least = Eigen::Vector2d::Constant(infinity), most = -least;
  for (const Mesh* mesh : meshes)
    for (const auto& vertex : mesh->vertices.rowwise()) {
      const Eigen::Vector2d p = to_plane * vertex.transpose();
      least = least.cwiseMin(p);
      most = most.cwiseMax(p);
    }
  const double spacing = (most - least).maxCoeff() / lines;
  if (!(spacing > 0)) return;
  to_plane /= spacing;
  origin = least / spacing + Eigen::Vector2d::Constant(0.5);
  columns = static_cast<int>(std::ceil((most - least).x() / spacing));
  rows = static_cast<int>(std::ceil((most - least).y() / spacing));
  cell = spacing * spacing;
}

// A triangle over the grid. Its corners are (s, t, height).
struct Triangle {
  std::array<Eigen::Vector3d, 3> corner;
  bool solid;  // of the closed mesh, not of a hull
};

struct Crossing {
  int column;
  int step;  // +1 where a line enters, -1 where it leaves
  double height;
  bool solid;
  bool operator<(const Crossing& other) const {
    return column != other.column ? column < other.column : height < other.height;
  }
};

// The first column right of the edge at the row. Both triangles at an edge find the same one, since the ends are taken
// in one order, and each grid point then lies in exactly one of the two.
double edge_column(const Eigen::Vector3d& a, const Eigen::Vector3d& b, int row) {
  const bool in_order = std::tie(a.y(), a.x()) < std::tie(b.y(), b.x());
  const Eigen::Vector3d &lower = in_order ? a : b, &upper = in_order ? b : a;
  return std::ceil(lower.x() + (row - lower.y()) / (upper.y() - lower.y()) * (upper.x() - lower.x()));
}

// Appends where the lines of a row cross the triangle. A row that passes through a corner belongs to the edges above
// it.
void cross(const Triangle& triangle, int row, int columns, std::vector<Crossing>& crossings) {
  const auto& [a, b, c] = triangle.corner;
  double up = 0, down = 0;  // Of the edges that rise and fall through the row, the first column right of each.
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d &p = triangle.corner[k], &q = triangle.corner[(k + 1) % 3];
    if (p.y() <= row && row < q.y()) up = edge_column(p, q, row);
    if (q.y() <= row && row < p.y()) down = edge_column(p, q, row);
  }
  const int first = static_cast<int>(std::clamp(std::min(up, down), 0.0, double(columns)));
  const int last = static_cast<int>(std::clamp(std::max(up, down), 0.0, double(columns)));
  if (first >= last) return;
  // Seen against the direction of the lines a counter-clockwise face is where they leave.
  const int step = down < up ? -1 : 1;
  const Eigen::Vector3d normal = (b - a).cross(c - a);
  const auto [low, high] = std::minmax({a.z(), b.z(), c.z()});
  for (int column = first; column < last; ++column) {
    const double rise = normal.x() * (column - a.x()) + normal.y() * (row - a.y());
    // Steep slivers: whatever the quotient is (0 / 0 as well), the height stays within the triangle's.
    const double height = normal.z() == 0 ? low : std::clamp(a.z() - rise / normal.z(), low, high);
    crossings.push_back({column, step, height, triangle.solid});
  }
}

// Lengths in the union of the hulls, in the solid, and in the solid alone, summed over the lines of a row.
std::array<double, 3> measure(std::vector<Crossing>& crossings) {
  std::sort(crossings.begin(), crossings.end());
  std::array<double, 3> length{};
  int hulls = 0, solid = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (i > 0 && crossings[i].column == crossings[i - 1].column) {
      const double step = crossings[i].height - crossings[i - 1].height;
      if (hulls != 0) length[0] += step;
      if (solid != 0) length[1] += step;
      if (solid != 0 && hulls == 0) length[2] += step;
    } else {
      hulls = solid = 0;
    }
    (crossings[i].solid ? solid : hulls) += crossings[i].step;
  }
  return length;
}

// Volumes of the union of the hulls, of the solid, and of the solid outside of the hulls. solid may be null.
std::array<double, 3> volumes(const Mesh* solid, std::span<const Mesh> hulls, int lines) {
  std::vector<const Mesh*> meshes;
  if (solid) meshes.push_back(solid);
  for (const Mesh& hull : hulls) meshes.push_back(&hull);
  const Grid grid(meshes, lines);

  std::vector<Triangle> triangles;
  std::vector<int> start(static_cast<std::size_t>(grid.rows) + 1, 0);  // of each row's list in `crossing`
  std::vector<std::array<int, 2>> span_of;                             // rows that each triangle crosses
  for (const Mesh* mesh : meshes) {
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> points(mesh->vertices.rows(), 3);
    points.leftCols<2>() = (mesh->vertices * grid.to_plane.transpose()).rowwise() - grid.origin.transpose();
    points.col(2) = mesh->vertices.col(grid.axis);
    for (const auto& f : mesh->faces.rowwise()) {
      const Triangle triangle{{points.row(f[0]), points.row(f[1]), points.row(f[2])}, mesh == solid};
      const auto [low, high] = std::minmax({triangle.corner[0].y(), triangle.corner[1].y(), triangle.corner[2].y()});
      const int first = std::max(0, static_cast<int>(std::ceil(low)));
      const int last = std::min(grid.rows, static_cast<int>(std::ceil(high)));
      if (first >= last) continue;
      triangles.push_back(triangle);
      span_of.push_back({first, last});
      for (int row = first; row < last; ++row) ++start[row + 1];
    }
  }
  for (int row = 0; row < grid.rows; ++row) start[row + 1] += start[row];
  std::vector<int> crossing(static_cast<std::size_t>(start.back())), fill(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int row = span_of[i][0]; row < span_of[i][1]; ++row) crossing[fill[row]++] = static_cast<int>(i);

  std::vector<std::array<double, 3>> of_row(static_cast<std::size_t>(grid.rows));
  tbb::parallel_for(tbb::blocked_range<int>(0, grid.rows), [&](const tbb::blocked_range<int>& range) {
    std::vector<Crossing> crossings;
    for (int row = range.begin(); row < range.end(); ++row) {
      crossings.clear();
      for (int i = start[row]; i < start[row + 1]; ++i) cross(triangles[crossing[i]], row, grid.columns, crossings);
      of_row[row] = measure(crossings);
    }
  });
  std::array<double, 3> sum{};
  for (const auto& lengths : of_row)
    for (int k = 0; k < 3; ++k) sum[k] += lengths[k] * grid.cell;
  return sum;
}

}  // namespace

double union_volume(std::span<const Mesh> hulls, const UnionVolumeSettings& settings) {
  return volumes(nullptr, hulls, settings.lines)[0];
}

Coverage coverage(const Mesh& solid, std::span<const Mesh> hulls, const UnionVolumeSettings& settings) {
  const auto [united, of_solid, uncovered] = volumes(&solid, hulls, settings.lines);
  return {united, of_solid, uncovered};
}

}  // namespace partwise
