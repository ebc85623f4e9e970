// A plain peer in the manner of minimum near-convex decomposition (Ren, Yuan, Liu 2011), which the method's own
// comparison (Liu 2017, 2.3.4.3) is against: no two corners of a part may be a mutex pair, and the cuts are as few as a
// 0-1 programme finds.
//
//   outline_mncd SHAPE PARTS.geojson --tolerance T [--seconds S]
//
// T as a share of R. Two corners are a mutex pair where the shortest path between them through the shape leaves the
// segment between them by more than T; holes are obstacles like any other. Candidates are the edges of a constrained
// Delaunay triangulation and, from every reflex corner, the eight shortest diagonals. Each row of the programme asks
// for one of the cuts that cross a path between a mutex pair; rows, and pairs of crossing cuts, are added until the
// chosen cuts leave no mutex pair together. Of equally many cuts those of least total length. CBC solves each
// programme; after S processor seconds what is chosen last stands, and "finished" is false. Prints {"parts", "cuts",
// "candidates", "mutex_pairs", "rows", "rounds", "finished", "seconds"}.
#include <coin/Cbc_C_Interface.h>
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <optional>
#include <set>

#include "bench/mncd/wedge_graph.h"
#include "partwise/parts/planar/hierarchical_concavity.h"
#include "partwise/parts/planar/read_shape.h"

namespace {

using namespace partwise;
using bench::WedgeGraph;

// Of this process, so that a busy machine does not count.
double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Totals {
  std::size_t cuts = 0, candidates = 0, mutex_pairs = 0, rows = 0;
  int rounds = 0;
  bool finished = true;
};

class Decomposer {
 public:
  Decomposer(std::vector<Point2> points, Region region, double tolerance, double deadline)
      : points_(std::move(points)), region_(std::move(region)), tolerance_(tolerance), deadline_(deadline) {}

  Polygons decompose(Totals& totals) {
    const WedgeGraph whole(points_, region_, {});
    find_mutex_pairs(whole);
    collect_candidates(whole);
    std::set<IndexEdge> chosen;
    bool finished = mutex_.empty();
    while (!finished && cpu_seconds() < deadline_) {
      ++totals.rounds;
      const bool crossing = add_conflicts(chosen);
      if (!crossing) finished = !add_rows(WedgeGraph(points_, region_, chosen));
      if (finished) break;
      chosen = solve();
    }
    while (add_conflicts(chosen)) chosen.erase(std::prev(chosen.end()));  // only where time ran out
    totals.cuts += chosen.size();
    totals.candidates += cuts_.size();
    for (const auto& [p, partners] : mutex_) totals.mutex_pairs += partners.size();
    totals.rows += rows_.size();
    totals.finished = totals.finished && finished;
    return split(chosen);
  }

 private:
  double length(const IndexEdge& cut) const { return (points_[cut.first] - points_[cut.second]).norm(); }
  int side(int a, int b, int c) const { return orientation(points_[a], points_[b], points_[c]); }

  // By smaller index the larger ones, with the depth.
  void find_mutex_pairs(const WedgeGraph& whole) {
    for (int node = 0; node < whole.size(); ++node) {
      const auto paths = whole.paths_from(node);
      const int p = whole.corner(node);
      for (int other = 0; other < whole.size(); ++other) {
        const int q = whole.corner(other);
        if (q <= p || !std::isfinite(paths.length[other])) continue;
        double depth = 0;
        for (int at = paths.before[other]; at >= 0; at = paths.before[at]) {
          depth = std::max(depth, distance_to_segment(points_[whole.corner(at)], points_[p], points_[q]));
        }
        if (depth > tolerance_) mutex_[p][q] = depth;
      }
    }
  }

  void collect_candidates(const WedgeGraph& whole) {
    std::vector<const IndexRing*> rings{&region_.outer};
    for (const IndexRing& hole : region_.holes) rings.push_back(&hole);
    const RegionMesh mesh(points_, rings);
    std::set<IndexEdge> sides, cuts;
    for (const IndexRing* ring : rings) for_each_edge(*ring, [&](int a, int b) { sides.insert(sorted(a, b)); });
    for (int corner = 0; corner < mesh.mesh().point_count(); ++corner) {
      for (int end : mesh.mesh().inside_neighbours(corner)) cuts.insert(sorted(mesh.point(corner), mesh.point(end)));
    }
    for (int node = 0; node < whole.size(); ++node) {
      if (!whole.bends(node)) continue;
      std::vector<std::pair<double, IndexEdge>> ends;
      for (int other : whole.neighbours(node)) {
        const IndexEdge cut = sorted(whole.corner(node), whole.corner(other));
        if (!sides.contains(cut)) ends.emplace_back(length(cut), cut);
      }
      std::sort(ends.begin(), ends.end());
      for (std::size_t i = 0; i < std::min<std::size_t>(8, ends.size()); ++i) cuts.insert(ends[i].second);
    }
    for (const IndexEdge& side : sides) cuts.erase(side);
    cuts_.assign(cuts.begin(), cuts.end());
  }

  bool cross(const IndexEdge& a, const IndexEdge& b) const {
    return side(a.first, a.second, b.first) * side(a.first, a.second, b.second) < 0 &&
           side(b.first, b.second, a.first) * side(b.first, b.second, a.second) < 0;
  }

  // Whether a cut at a corner where the path bends leaves on the path's outer side, where the path would have to pass.
  bool blocks(const std::vector<int>& path, std::size_t i, int end) const {
    const int turn = side(path[i - 1], path[i], path[i + 1]);
    const int in = side(path[i - 1], path[i], end), out = side(path[i], path[i + 1], end);
    if (turn == 0) return in != 0;
    return in == -turn || out == -turn;
  }

  bool crosses(const IndexEdge& cut, const std::vector<int>& path) const {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      if (cross(cut, {path[i], path[i + 1]})) return true;
      // A path along a cut changes sides where it bends one way before and the other way after.
      if (cut == sorted(path[i], path[i + 1]) && i > 0 && i + 2 < path.size() &&
          side(path[i - 1], path[i], path[i + 1]) * side(path[i], path[i + 1], path[i + 2]) < 0) {
        return true;
      }
    }
    for (std::size_t i = 1; i + 1 < path.size(); ++i) {
      for (const auto& [at, end] : {cut, IndexEdge(cut.second, cut.first)}) {
        if (path[i] == at && end != path[i - 1] && end != path[i + 1] && blocks(path, i, end)) return true;
      }
    }
    return false;
  }

  // Rows for mutex pairs that are still together: for each corner its deepest partner and its nearest.
  bool add_rows(const WedgeGraph& graph) {
    const std::vector<int> component = graph.components();
    const std::size_t before = rows_.size();
    for (int node = 0; node < graph.size(); ++node) {
      const auto of = mutex_.find(graph.corner(node));
      if (of == mutex_.end()) continue;
      int deepest = -1, nearest = -1;
      std::optional<WedgeGraph::Paths> paths;
      double depth = 0;
      for (int other = 0; other < graph.size(); ++other) {
        if (component[other] != component[node]) continue;
        const auto pair = of->second.find(graph.corner(other));
        if (pair == of->second.end()) continue;
        if (!paths) paths = graph.paths_from(node);
        if (pair->second > depth) depth = pair->second, deepest = other;
        if (nearest < 0 || paths->length[other] < paths->length[nearest]) nearest = other;
      }
      for (int other : {deepest, nearest}) {
        if (other < 0) continue;
        const std::vector<int> path = graph.path_to(*paths, other);
        std::vector<int> row;
        for (std::size_t c = 0; c < cuts_.size(); ++c) {
          if (crosses(cuts_[c], path)) row.push_back(static_cast<int>(c));
        }
        if (!row.empty()) rows_.insert(std::move(row));
      }
    }
    return rows_.size() > before;
  }

  bool add_conflicts(const std::set<IndexEdge>& chosen) {
    bool found = false;
    for (auto a = chosen.begin(); a != chosen.end(); ++a) {
      for (auto b = std::next(a); b != chosen.end(); ++b) {
        if (cross(*a, *b)) conflicts_.insert({*a, *b}), found = true;
      }
    }
    return found;
  }

  std::set<IndexEdge> solve() const {
    double total = 1;
    for (const IndexEdge& cut : cuts_) total += length(cut);
    Cbc_Model* model = Cbc_newModel();
    Cbc_setParameter(model, "logLevel", "0");
    Cbc_setParameter(model, "seconds", fmt::format("{:.1f}", std::max(1.0, deadline_ - cpu_seconds())).c_str());
    for (std::size_t c = 0; c < cuts_.size(); ++c) {
      Cbc_addCol(model, "", 0, 1, 1 + length(cuts_[c]) / total, 1, 0, nullptr, nullptr);
    }
    const std::vector<double> ones(cuts_.size(), 1);
    for (const std::vector<int>& row : rows_) {
      Cbc_addRow(model, "", static_cast<int>(row.size()), row.data(), ones.data(), 'G', 1);
    }
    const auto index = [&](const IndexEdge& cut) {
      return static_cast<int>(std::lower_bound(cuts_.begin(), cuts_.end(), cut) - cuts_.begin());
    };
    for (const auto& [a, b] : conflicts_) {
      const int pair[] = {index(a), index(b)};
      Cbc_addRow(model, "", 2, pair, ones.data(), 'L', 1);
    }
    Cbc_solve(model);
    std::set<IndexEdge> chosen;
    if (const double* solution = Cbc_bestSolution(model)) {
      for (std::size_t c = 0; c < cuts_.size(); ++c) {
        if (solution[c] > 0.5) chosen.insert(cuts_[c]);
      }
    }
    Cbc_deleteModel(model);
    return chosen;
  }

  Polygons split(const std::set<IndexEdge>& chosen) const {
    std::vector<const IndexRing*> rings{&region_.outer};
    for (const IndexRing& hole : region_.holes) rings.push_back(&hole);
    RegionMesh mesh(points_, rings);
    for (const auto& [a, b] : chosen) mesh.mesh().insert_edge(mesh.local(a), mesh.local(b));
    Polygons parts;
    const auto is_cut = [&](int a, int b) { return chosen.contains(sorted(mesh.point(a), mesh.point(b))); };
    for (const Region& part : mesh.split(points_, is_cut)) parts.push_back(to_polygon(points_, part));
    return parts;
  }

  std::vector<Point2> points_;
  Region region_;
  double tolerance_;
  double deadline_;
  std::map<int, std::map<int, double>> mutex_;
  std::vector<IndexEdge> cuts_;  // ascending
  std::set<std::vector<int>> rows_;
  std::set<std::pair<IndexEdge, IndexEdge>> conflicts_;
};

Polygons decompose(const Polygons& shape, double tolerance, double seconds, Totals& totals) {
  const double deadline = cpu_seconds() + seconds;
  Polygons parts;
  for (const Polygon& polygon : shape) {
    IndexedPolygon indexed = to_region(polygon);
    for (Polygon& part : Decomposer(indexed.points, std::move(indexed.region), tolerance, deadline).decompose(totals)) {
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Decomposes a shape by mutex pairs and a 0-1 programme.", "outline_mncd");
  std::string shape, parts;
  double tolerance = 0.05, seconds = 60;
  program.add_option("SHAPE", shape)->required();
  program.add_option("PARTS", parts)->required();
  program.add_option("--tolerance", tolerance);
  program.add_option("--seconds", seconds);
  CLI11_PARSE(program, argc, argv);
  try {
    const Polygons polygons = read_shape(shape, {.lenient = true}).polygons;
    const double start = cpu_seconds();
    Totals totals;
    const Polygons result = decompose(polygons, tolerance * enclosing_circle(polygons).radius, seconds, totals);
    const double elapsed = cpu_seconds() - start;
    write_geojson(parts, result);
    fmt::print(
        "{{\"parts\": {}, \"cuts\": {}, \"candidates\": {}, \"mutex_pairs\": {}, \"rows\": {}, \"rounds\": {}, "
        "\"finished\": {}, \"seconds\": {}}}\n",
        result.size(), totals.cuts, totals.candidates, totals.mutex_pairs, totals.rows, totals.rounds, totals.finished,
        elapsed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "outline_mncd: {}\n", error.what());
    return 1;
  }
  return 0;
}
