// A plain peer in the manner of approximate convex decomposition (Lien, Amato 2006): one notch after the other is cut
// at its deepest corner, by straight-line concavity; every hole counts as structure, noise or not.
//
//   outline_peer SHAPE PARTS.geojson --tolerance T
//
// T as a share of R. Cuts are diagonals of a constrained Delaunay triangulation: of those that resolve the notch the
// shortest, else the shortest two at it. Holes go first, all at once, each cut at both antipodal corners along its
// shortest edge to another ring. Prints {"parts": N, "seconds": S}.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <chrono>
#include <set>

#include "partwise/parts/planar/hierarchical_concavity.h"
#include "partwise/parts/planar/pockets.h"
#include "partwise/parts/planar/read_shape.h"
#include "partwise/parts/planar/region.h"
#include "partwise/parts/planar/resolvers.h"

namespace {

using namespace partwise;

class Peer {
 public:
  Peer(std::vector<Point2> points, double tolerance) : points_(std::move(points)), tolerance_(tolerance) {}

  std::vector<Region> decompose(const Region& whole) const {
    std::vector<Region> queue{whole}, parts;
    while (!queue.empty()) {
      const Region region = std::move(queue.back());
      queue.pop_back();
      std::vector<Region> pieces;
      if (!region.holes.empty()) {
        pieces = open_holes(region);
      } else if (const auto notch = deepest(region.outer); notch.second > tolerance_) {
        pieces = cut_notch(region, notch.first);
      }
      if (pieces.size() > 1) {
        queue.insert(queue.end(), pieces.begin(), pieces.end());
      } else {
        parts.push_back(region);
      }
    }
    return parts;
  }

  std::span<const Point2> points() const { return points_; }

 private:
  static std::vector<const IndexRing*> rings_of(const Region& region) {
    std::vector<const IndexRing*> rings{&region.outer};
    for (const IndexRing& hole : region.holes) rings.push_back(&hole);
    return rings;
  }

  double length(int a, int b) const { return (points_[a] - points_[b]).norm(); }

  std::vector<Region> split(const RegionMesh& mesh, const std::set<IndexEdge>& cuts) const {
    return mesh.split(points_, [&](int a, int b) {
      return cuts.contains({mesh.point(a), mesh.point(b)}) || cuts.contains({mesh.point(b), mesh.point(a)});
    });
  }

  std::vector<Region> open_holes(const Region& region) const {
    const RegionMesh mesh(points_, rings_of(region));
    std::set<IndexEdge> cuts;
    for (const IndexRing& hole : region.holes) {
      const std::set<int> own(hole.begin(), hole.end());
      const AntipodalPair pair = antipodal_pair(points_, hole);
      std::vector<std::pair<double, IndexEdge>> ways;  // from every corner: the antipodes may see only their own hole
      for (int v : hole) {
        for (int end : mesh.mesh().inside_neighbours(mesh.local(v))) {
          const int u = mesh.point(end);
          const bool preferred = v == pair.a || v == pair.b;
          if (!own.contains(u)) ways.push_back({length(u, v) * (preferred ? 1e-9 : 1), {v, u}});
        }
      }
      std::sort(ways.begin(), ways.end());
      int taken = -1;
      for (const auto& [cost, edge] : ways) {
        if (edge.first == taken || cuts.contains({edge.second, edge.first})) continue;
        cuts.insert(edge);
        if (taken >= 0) break;
        taken = edge.first;
      }
    }
    return split(mesh, cuts);
  }

  std::pair<int, double> deepest(const IndexRing& ring) const {
    std::pair<int, double> best{-1, 0};
    for (const IndexRing& chain : hull_pockets(points_, ring)) {
      for (int v : chain) {
        const double depth = distance_to_segment(points_[v], points_[chain.front()], points_[chain.back()]);
        if (depth > best.second) best = {v, depth};
      }
    }
    return best;
  }

  std::vector<Region> cut_notch(const Region& region, int v) const {
    const RegionMesh mesh(points_, rings_of(region));
    const auto at = std::find(region.outer.begin(), region.outer.end(), v) - region.outer.begin();
    const auto n = static_cast<std::ptrdiff_t>(region.outer.size());
    const Corner corner{points_[v], points_[region.outer[(at + 1) % n]], points_[region.outer[(at + n - 1) % n]]};
    std::vector<std::pair<double, int>> good, all;
    for (int end : mesh.mesh().inside_neighbours(mesh.local(v))) {
      const int u = mesh.point(end);
      const Point2 one[] = {points_[u]};
      all.emplace_back(length(u, v), u);
      if (resolves(corner, one, tolerance_)) good.emplace_back(length(u, v), u);
    }
    if (!good.empty()) return split(mesh, {{v, std::min_element(good.begin(), good.end())->second}});
    std::sort(all.begin(), all.end());
    std::set<IndexEdge> cuts;
    for (std::size_t k = 0; k < std::min<std::size_t>(2, all.size()); ++k) cuts.insert({v, all[k].second});
    return split(mesh, cuts);
  }

  std::vector<Point2> points_;
  double tolerance_;
};

Polygons decompose(const Polygons& shape, double tolerance) {
  Polygons parts;
  for (const Polygon& polygon : shape) {
    const auto [points, region] = to_region(polygon);
    const Peer peer(points, tolerance);
    for (const Region& part : peer.decompose(region)) parts.push_back(to_polygon(peer.points(), part));
  }
  return parts;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Decomposes a shape notch by notch.", "outline_peer");
  std::string shape, parts;
  double tolerance = 0.05;
  program.add_option("SHAPE", shape)->required();
  program.add_option("PARTS", parts)->required();
  program.add_option("--tolerance", tolerance);
  CLI11_PARSE(program, argc, argv);
  try {
    const Polygons polygons = read_shape(shape, {.lenient = true}).polygons;
    const auto start = std::chrono::steady_clock::now();
    const Polygons result = decompose(polygons, tolerance * enclosing_circle(polygons).radius);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    write_geojson(parts, result);
    fmt::print("{{\"parts\": {}, \"seconds\": {}}}\n", result.size(), elapsed.count());
  } catch (const std::exception& error) {
    fmt::print(stderr, "outline_peer: {}\n", error.what());
    return 1;
  }
  return 0;
}
