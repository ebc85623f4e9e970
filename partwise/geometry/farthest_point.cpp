#include "partwise/geometry/farthest_point.h"

#include <algorithm>
#include <array>
#include <queue>
#include <tuple>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

struct Piece {
  double bound = 0;
  std::array<Point, 3> corners;
  long number = 0;  // so that equal bounds have an order
  bool operator<(const Piece& other) const { return std::tie(bound, other.number) < std::tie(other.bound, number); }
};

}  // namespace

double farthest_point(const Mesh& surface, const std::function<double(const Point&)>& distance, double precision) {
  if (!(precision > 0))
    throw InputError("precision", fmt::format("{} is not a length", precision), "give a positive number");
  PARTWISE_CHECK(surface.faces.rows(), >, 0);
  std::priority_queue<Piece> pieces;
  double found = 0;
  long count = 0;
  const auto add = [&](const std::array<Point, 3>& corners) {
    const Point middle = (corners[0] + corners[1] + corners[2]) / 3;
    double radius = 0;
    for (const Point& corner : corners) radius = std::max(radius, (corner - middle).norm());
    const double value = distance(middle);
    found = std::max(found, value);
    if (value + radius > found + precision) pieces.push({value + radius, corners, count++});
  };
  for (const auto& f : surface.faces.rowwise())
    add({surface.vertices.row(f[0]), surface.vertices.row(f[1]), surface.vertices.row(f[2])});
  while (!pieces.empty() && pieces.top().bound > found + precision) {
    const std::array<Point, 3> corners = pieces.top().corners;
    pieces.pop();
    std::size_t longest = 0;
    const auto side = [&](std::size_t k) { return (corners[(k + 1) % 3] - corners[k]).squaredNorm(); };
    for (std::size_t k = 1; k < 3; ++k)
      if (side(k) > side(longest)) longest = k;
    const Point &a = corners[longest], &b = corners[(longest + 1) % 3], &c = corners[(longest + 2) % 3];
    const Point middle = (a + b) / 2;
    add({a, middle, c});
    add({middle, b, c});
  }
  return found + precision;
}

}  // namespace partwise
