#include "partwise/parts/solid/part_merging.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <set>

#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/solid/plane_split.h"

namespace partwise {
namespace {

constexpr double kGrowthPrice = 0.1;  // of a volume of solid taken in, against the same volume of air
constexpr std::size_t kMostPiecesToDissolve = 12;

// Whether b's hull lies in a's: then theirs together is a's.
bool encloses(const HullPart& a, const HullPart& b) {
  constexpr double kOnPlane = 1e-14;  // shared corners are on the planes to rounding
  if (((b.hull.vertices.colwise().maxCoeff() - a.hull.vertices.colwise().maxCoeff()).array() > 0).any() ||
      ((a.hull.vertices.colwise().minCoeff() - b.hull.vertices.colwise().minCoeff()).array() > 0).any())
    return false;
  const auto planes = hull_planes(a.hull);
  for (const auto& corner : b.hull.vertices.rowwise())
    if ((planes.leftCols<3>() * corner.transpose() - planes.col(3)).maxCoeff() > kOnPlane) return false;
  return true;
}

std::uint64_t hash(const std::vector<int>& faces) {  // FNV-1a
  std::uint64_t h = 0xCBF29CE484222325u;
  for (const int f : faces) h = (h ^ static_cast<std::uint64_t>(f)) * 0x100000001B3u;
  return h;
}

Vertices stacked(const Vertices& a, const Vertices& b) {
  Vertices both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

std::vector<std::vector<int>> neighbours_by_vertex(const Mesh& mesh, const std::vector<HullPart>& pieces) {
  std::vector<std::vector<int>> at_vertex(static_cast<std::size_t>(mesh.vertices.rows()));
  for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
    for (int f : pieces[p].faces) {
      for (int k = 0; k < 3; ++k) {
        auto& here = at_vertex[mesh.faces(f, k)];
        if (here.empty() || here.back() != p) here.push_back(p);
      }
    }
  }
  std::vector<std::set<int>> sets(pieces.size());
  for (const auto& here : at_vertex)
    for (int a : here)
      for (int b : here)
        if (a != b) sets[a].insert(b);
  std::vector<std::vector<int>> neighbours;
  neighbours.reserve(sets.size());
  for (const auto& set : sets) neighbours.emplace_back(set.begin(), set.end());
  return neighbours;
}

}  // namespace

double largest_air(const SpaceSamples& space, double tolerance, double factor) {
  const double solid = space.volume * static_cast<double>(space.solid.size());
  return solid > 0 ? factor * tolerance * tolerance * solid : std::numeric_limits<double>::infinity();
}

PartMerging::PartMerging(const Mesh& mesh, const SpaceSamples& space, std::vector<HullPart> pieces, AcceptMerge accept,
                         const MergeSettings& settings)
    : mesh_(mesh),
      space_(space),
      accept_(std::move(accept)),
      settings_(settings),
      pieces_(std::move(pieces)),
      piece_neighbours_(neighbours_by_vertex(mesh, pieces_)),
      part_of_(pieces_.size()),
      parts_(pieces_.size()),
      covered_(static_cast<std::size_t>(space.air.size()), 0) {
  std::iota(part_of_.begin(), part_of_.end(), 0);
  for (int p = 0; p < static_cast<int>(parts_.size()); ++p) {
    parts_[p].pieces = {p};
    replace(p, pieces_[p]);
  }
}

// From the sketches: the volume of the air that no hull holds yet, and a little for the growth of the hulls, so that
// among those that take in none the one that grows least comes first.
double PartMerging::cost_of(const HullPart& a, const HullPart& b) const {
  const ConvexHull hull = convex_hull(stacked(a.sketch, b.sketch), settings_.minimum_thickness);
  double air = 0;
  for (int point : space_.air.inside(hull.mesh)) air += covered_[point] == 0 ? space_.volume : 0;
  if (air > settings_.largest_air) return std::numeric_limits<double>::infinity();
  return air + kGrowthPrice * std::max(0.0, hull.volume - a.volume - b.volume);
}

bool PartMerging::joined(const HullPart& a, const HullPart& b, HullPart& result) {
  HullPart merged;
  merged.faces.resize(a.faces.size() + b.faces.size());
  std::merge(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(), merged.faces.begin());
  const std::uint64_t key = hash(merged.faces);
  if (refused_joins_.count(key)) return false;
  if (const HullPart* outer = encloses(a, b) ? &a : encloses(b, a) ? &b : nullptr) {
    std::vector<int> faces = std::move(merged.faces);
    merged = *outer;
    merged.faces = std::move(faces);
  } else {
    Corners both = exact_corners(mesh_, a);
    const Corners more = exact_corners(mesh_, b);
    both.append(more.points, more.source);
    set_hull(merged, both, settings_.minimum_thickness);
  }
  if (!accept_(merged)) {
    refused_joins_.insert(key);
    return false;
  }
  result = std::move(merged);
  return true;
}

void PartMerging::replace(int part, HullPart body) {
  Part& p = parts_[part];
  for (int i : p.air) --covered_[i];
  p.body = std::move(body);
  p.air.clear();
  if (!p.body.faces.empty()) p.air = space_.air.inside(p.body.hull);
  for (int i : p.air) ++covered_[i];
  ++p.version;
}

std::vector<int> PartMerging::neighbours(int part) const {
  std::vector<int> result;
  for (int piece : parts_[part].pieces)
    for (int other : piece_neighbours_[piece])
      if (part_of_[other] != part) result.push_back(part_of_[other]);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void PartMerging::connect_all() {
  constexpr std::size_t kNearest = 8;
  const auto count = static_cast<int>(pieces_.size());
  std::vector<Point> centre;
  for (const HullPart& piece : pieces_) centre.push_back(piece.hull.vertices.colwise().mean());
  const auto link = [&](int a, int b) {
    piece_neighbours_[a].push_back(b);
    piece_neighbours_[b].push_back(a);
  };
  std::vector<int> order(pieces_.size());
  for (int a = 0; a < count; ++a) {
    if (a > 0) link(a - 1, a);  // A chain through all: nothing stays apart.
    std::iota(order.begin(), order.end(), 0);
    const std::size_t nearest = std::min(kNearest, order.size());
    std::partial_sort(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(nearest), order.end(), [&](int x, int y) {
          const double dx = (centre[x] - centre[a]).squaredNorm(), dy = (centre[y] - centre[a]).squaredNorm();
          return dx != dy ? dx < dy : x < y;
        });
    for (std::size_t i = 0; i < nearest; ++i)
      if (order[i] != a) link(a, order[i]);
  }
  for (auto& list : piece_neighbours_) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

void PartMerging::merge(const Progress& progress, int at_least) {
  auto count =
      static_cast<int>(std::count_if(parts_.begin(), parts_.end(), [](const Part& p) { return !p.pieces.empty(); }));
  struct Candidate {
    double cost;
    int a, b, version_a, version_b;
    bool operator<(const Candidate& other) const {  // The queue's top is the cheapest, then the first pair.
      if (cost != other.cost) return cost > other.cost;
      return a != other.a ? a > other.a : b > other.b;
    }
  };
  std::priority_queue<Candidate> queue;
  std::vector<std::pair<int, int>> fresh;
  for (int a = 0; a < static_cast<int>(parts_.size()); ++a)
    for (int b : neighbours(a))
      if (a < b && !parts_[a].refused.count(b)) fresh.emplace_back(a, b);
  double merged = 0;
  for (;;) {
    std::vector<double> cost(fresh.size());
    tbb::parallel_for(std::size_t{0}, fresh.size(), [&](std::size_t i) {
      cost[i] = cost_of(parts_[fresh[i].first].body, parts_[fresh[i].second].body);
    });
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      const auto [a, b] = fresh[i];
      if (std::isfinite(cost[i])) queue.push({cost[i], a, b, parts_[a].version, parts_[b].version});
    }
    fresh.clear();
    while (fresh.empty()) {
      if (queue.empty() || count <= at_least) return;
      const auto [c, a, b, version_a, version_b] = queue.top();
      queue.pop();
      if (parts_[a].version != version_a || parts_[b].version != version_b) continue;
      HullPart both;
      if (!joined(parts_[a].body, parts_[b].body, both)) {
        parts_[a].refused.insert(b);
        parts_[b].refused.insert(a);
        continue;
      }
      for (int r : parts_[b].refused) {
        parts_[a].refused.insert(r);
        parts_[r].refused.insert(a);
      }
      for (int piece : parts_[b].pieces) part_of_[piece] = a;
      parts_[a].pieces.insert(parts_[a].pieces.end(), parts_[b].pieces.begin(), parts_[b].pieces.end());
      parts_[b].pieces.clear();
      replace(b, {});
      replace(a, std::move(both));
      --count;
      for (int n : neighbours(a))
        if (!parts_[a].refused.count(n)) fresh.emplace_back(std::min(n, a), std::max(n, a));
      if (fresh.empty()) break;
      progress("merging", ++merged / static_cast<double>(parts_.size()));
    }
  }
}

std::vector<std::pair<int, int>> PartMerging::surroundings(int part) const {
  std::vector<std::pair<int, int>> result{{part, parts_[part].version}};
  for (int n : neighbours(part)) result.emplace_back(n, parts_[n].version);
  return result;
}

bool PartMerging::dissolve_part(int part) {
  const std::vector<std::pair<int, int>> around = surroundings(part);
  if (around == parts_[part].stuck_among) return false;
  std::map<int, HullPart> taker;  // the neighbours as they would become
  const auto body = [&](int p) -> const HullPart& {
    const auto found = taker.find(p);
    return found != taker.end() ? found->second : parts_[p].body;
  };
  std::vector<int> left = parts_[part].pieces;
  std::map<int, int> goes_to;
  std::set<std::pair<int, int>> refused;        // (piece, part): a larger part would be refused as well
  std::map<std::pair<int, int>, double> known;  // (piece, part): cost, until the part grows
  while (!left.empty()) {
    std::vector<Growth> growths, fresh;
    for (int piece : left) {
      std::set<int> beside;
      for (int other : piece_neighbours_[piece]) {
        const auto moved = goes_to.find(other);
        const int owner = moved != goes_to.end() ? moved->second : part_of_[other];
        if (owner != part && !refused.count({piece, owner}) && !parts_[owner].refused_pieces.count(piece))
          beside.insert(owner);
      }
      for (int p : beside) {
        const auto cost = known.find({piece, p});
        if (cost != known.end())
          growths.push_back({cost->second, piece, p});
        else
          fresh.push_back({0, piece, p});
      }
    }
    tbb::parallel_for(std::size_t{0}, fresh.size(),
                      [&](std::size_t i) { fresh[i].cost = cost_of(body(fresh[i].part), pieces_[fresh[i].piece]); });
    for (const Growth& g : fresh) known[{g.piece, g.part}] = g.cost;
    growths.insert(growths.end(), fresh.begin(), fresh.end());
    std::sort(growths.begin(), growths.end(), [](const Growth& x, const Growth& y) {
      if (x.cost != y.cost) return x.cost < y.cost;
      return x.piece != y.piece ? x.piece < y.piece : x.part < y.part;
    });
    bool placed = false;
    for (const Growth& g : growths) {
      HullPart grown;
      if (!std::isfinite(g.cost) || !joined(body(g.part), pieces_[g.piece], grown)) {
        refused.insert({g.piece, g.part});
        if (!taker.count(g.part)) parts_[g.part].refused_pieces.insert(g.piece);
        continue;
      }
      taker[g.part] = std::move(grown);
      std::erase_if(known, [&](const auto& entry) { return entry.first.second == g.part; });
      goes_to[g.piece] = g.part;
      std::erase(left, g.piece);
      placed = true;
      break;
    }
    if (!placed) {
      parts_[part].stuck_among = around;
      return false;
    }
  }
  for (const auto& [piece, to] : goes_to) {
    part_of_[piece] = to;
    parts_[to].pieces.push_back(piece);
  }
  for (auto& [p, grown] : taker) replace(p, std::move(grown));
  parts_[part].pieces.clear();
  replace(part, {});
  return true;
}

int PartMerging::dissolve(const Progress& progress) {
  std::vector<int> order;
  for (int p = 0; p < static_cast<int>(parts_.size()); ++p)
    if (!parts_[p].pieces.empty() && parts_[p].pieces.size() <= kMostPiecesToDissolve) order.push_back(p);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return parts_[a].body.volume < parts_[b].body.volume; });
  int gone = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    progress("dissolving", static_cast<double>(i) / static_cast<double>(order.size()));
    gone += dissolve_part(order[i]);
  }
  return gone;
}

void PartMerging::refine() {
  std::vector<HullPart> finer;
  std::vector<int> part_of;
  for (std::size_t p = 0; p < pieces_.size(); ++p) {
    for (auto& group : halve(mesh_, pieces_[p].faces)) {
      finer.push_back(hull_part(mesh_, std::move(group), settings_.minimum_thickness));
      part_of.push_back(part_of_[p]);
    }
  }
  pieces_ = std::move(finer);
  part_of_ = std::move(part_of);
  piece_neighbours_ = neighbours_by_vertex(mesh_, pieces_);
  for (Part& part : parts_) {
    part.pieces.clear();
    part.refused_pieces.clear();
    part.stuck_among.clear();
  }
  for (int p = 0; p < static_cast<int>(pieces_.size()); ++p) parts_[part_of_[p]].pieces.push_back(p);
}

std::vector<HullPart> PartMerging::parts() const {
  std::vector<HullPart> result;
  for (const Part& part : parts_)
    if (!part.pieces.empty()) result.push_back(part.body);
  return result;
}

}  // namespace partwise
