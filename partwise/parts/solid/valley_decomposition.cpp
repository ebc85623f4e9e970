#include "partwise/parts/solid/valley_decomposition.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "partwise/geometry/disjoint_sets.h"
#include "partwise/parts/solid/convex_ridges.h"
#include "partwise/parts/solid/plane_split.h"
#include "partwise/parts/solid/ridge_separation.h"

namespace partwise {
namespace {

// Rims are cut when the largest piece's concavity is at most this share of the whole's.
constexpr double kConcavityLeft = 0.8;
// Where the largest piece of a hollow part keeps more than this share of the faces, a plane cuts the part instead.
constexpr double kFacesLeft = 0.5;

// Numbers the pieces of each label that hang together by edges; a piece without a vertex of its ridge joins the piece
// with which it shares the longest border. Returns the piece of each local face.
std::vector<int> pieces(const PartGraph& part, const ConvexRidges& ridges, const std::vector<int>& label) {
  DisjointSets sets(label.size());
  for (const auto& e : part.shared)
    if (label[e.face] == label[e.other]) sets.join(e.face, e.other);
  std::vector<char> rooted(label.size(), 0);
  for (std::size_t f = 0; f < label.size(); ++f)
    for (int v : part.corners[f])
      if (ridges.of_vertex[v] == label[f]) rooted[sets.find(static_cast<int>(f))] = 1;
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::pair<int, int>, double> border;
    for (const auto& e : part.shared) {
      const int a = sets.find(e.face), b = sets.find(e.other);
      if (a == b) continue;
      const double length = (part.positions.row(e.a) - part.positions.row(e.b)).norm();
      if (!rooted[a]) border[{a, b}] += length;
      if (!rooted[b]) border[{b, a}] += length;
    }
    std::map<int, std::pair<double, int>> best;
    for (const auto& [pair, length] : border) {
      auto& entry = best[pair.first];
      if (length > entry.first) entry = {length, pair.second};
    }
    for (const auto& [piece, neighbour] : best) {
      const int a = sets.find(piece), b = sets.find(neighbour.second);
      if (a == b) continue;
      const char either = rooted[a] || rooted[b];
      sets.join(a, b);
      rooted[sets.find(a)] = either;
      changed = true;
    }
  }
  std::vector<int> piece(label.size());
  for (std::size_t f = 0; f < label.size(); ++f) piece[f] = sets.find(static_cast<int>(f));
  return piece;
}

// The pieces of a part with deep valleys, cut between its ridges; the part itself where no cut was found.
std::vector<std::vector<int>> separate(const Mesh& mesh, const PartGraph& part, const Bridges& bridges,
                                       double tolerance) {
  const ConvexRidges ridges = convex_ridges(part, bridges);
  const std::vector<int> piece = pieces(part, ridges, separate_ridges(part, bridges, ridges, tolerance));
  std::map<int, std::vector<int>> by_piece;
  for (std::size_t f = 0; f < piece.size(); ++f) by_piece[piece[f]].push_back(part.faces[f]);
  std::vector<std::vector<int>> groups;
  for (auto& [key, members] : by_piece)
    for (auto& group : connected_groups(mesh, members)) groups.push_back(std::move(group));
  return groups;
}

// The most concave of some valleys, null for none.
const Valley* deepest(const std::vector<Valley>& valleys) {
  const auto found = std::max_element(valleys.begin(), valleys.end(),
                                      [](const Valley& a, const Valley& b) { return a.concavity < b.concavity; });
  return found == valleys.end() ? nullptr : &*found;
}

const std::vector<int>& largest(const std::vector<std::vector<int>>& groups) {
  return *std::max_element(groups.begin(), groups.end(),
                           [](const auto& a, const auto& b) { return a.size() < b.size(); });
}

}  // namespace

std::vector<std::vector<int>> separate_once(const Mesh& mesh, const SurfaceQuery& surface,
                                            const std::vector<int>& faces, double tolerance, const CupRepair& repair) {
  const PartGraph part = part_graph(mesh, faces);
  Bridges bridges = find_bridges(part, part_hull(part, tolerance), surface, tolerance, repair);
  if (const Valley* valley = deepest(bridges.deep)) {
    std::vector<std::vector<int>> groups = separate(mesh, part, bridges, tolerance);
    // Ridges along the mouth of a hollow keep little more than the rim, and what is left is as hollow as before.
    const bool crumbled = static_cast<double>(largest(groups).size()) > kFacesLeft * static_cast<double>(faces.size());
    if (groups.size() > 1 && !(valley->through_hollow && crumbled)) return groups;
    return split_by_plane(mesh, faces, part.positions.row(valley->deepest), kBridgeThickness * tolerance);
  }
  if (bridges.rims.empty()) return {faces};
  // Rims alone: separate there if that makes them shallower.
  const double before = deepest(bridges.rims)->concavity;
  bridges.deep = std::move(bridges.rims);
  std::vector<std::vector<int>> groups = separate(mesh, part, bridges, tolerance);
  const PartGraph left = part_graph(mesh, largest(groups));
  const Bridges after = find_bridges(left, part_hull(left, tolerance), surface, tolerance, repair);
  const Valley* rim = deepest(after.rims);
  if (std::max(after.concavity, rim ? rim->concavity : 0) > kConcavityLeft * before) return {faces};
  return groups;
}

std::vector<std::vector<int>> valley_decomposition(const Mesh& mesh, const SurfaceQuery& surface,
                                                   std::vector<int> faces, double tolerance, const CupRepair& repair,
                                                   const Progress& progress) {
  std::vector<std::vector<int>> done, open{std::move(faces)};
  const double total = static_cast<double>(open.front().size());
  double finished = 0;
  while (!open.empty()) {
    progress("convex ridges", finished / total);
    std::vector<int> current = std::move(open.back());
    open.pop_back();
    std::vector<std::vector<int>> split = separate_once(mesh, surface, current, tolerance, repair);
    if (split.size() > 1) {
      for (auto& group : split) open.push_back(std::move(group));
    } else {
      finished += static_cast<double>(current.size());
      done.push_back(std::move(current));
    }
  }
  std::sort(done.begin(), done.end(), [](const auto& a, const auto& b) { return a.front() < b.front(); });
  return done;
}

}  // namespace partwise
