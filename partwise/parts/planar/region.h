// Regions of a polygon whose corners are indices into one list of points, so that parts share corners exactly.
//
// A region is one outer ring, counter-clockwise, and holes, clockwise: the region lies to the left of every edge. Rings
// are simple; rings of one region may touch at corners.
#pragma once

#include <functional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "partwise/geometry/constrained_delaunay.h"
#include "partwise/geometry/polygon.h"

namespace partwise {

using IndexRing = std::vector<int>;
using IndexEdge = std::pair<int, int>;

// An edge that has no direction, by its smaller end first.
inline IndexEdge sorted(int a, int b) { return a < b ? IndexEdge(a, b) : IndexEdge(b, a); }

struct Region {
  IndexRing outer;
  std::vector<IndexRing> holes;
};

// The region to the left of directed edges that bound one connected region. Errors: CheckFailed when they bound none.
Region trace_region(std::span<const Point2> points, std::vector<IndexEdge> edges);

// Calls `visit` with the start and the end of every edge of the ring.
template <typename Visit>
void for_each_edge(const IndexRing& ring, Visit&& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
}

// The triangulation of a region, with names of its vertices here and in the list of points.
class RegionMesh {
 public:
  // `rings` bound what is inside.
  RegionMesh(std::span<const Point2> points, std::span<const IndexRing* const> rings);

  ConstrainedDelaunay& mesh() { return mesh_; }
  const ConstrainedDelaunay& mesh() const { return mesh_; }
  int local(int point) const { return local_.at(point); }
  int point(int local) const { return points_[local]; }

  // What is inside, split along the edges for which `is_cut` (local names, either direction) holds.
  std::vector<Region> split(std::span<const Point2> points, const std::function<bool(int, int)>& is_cut) const;

 private:
  std::vector<int> points_;  // of each local vertex
  std::unordered_map<int, int> local_;
  ConstrainedDelaunay mesh_;
};

// A polygon as a region of its own corners; equal corners are one point.
struct IndexedPolygon {
  std::vector<Point2> points;
  Region region;
};
IndexedPolygon to_region(const Polygon& polygon);
Polygon to_polygon(std::span<const Point2> points, const Region& region);

}  // namespace partwise
