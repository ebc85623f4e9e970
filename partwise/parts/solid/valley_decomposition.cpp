#include "partwise/parts/solid/valley_decomposition.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "partwise/geometry/disjoint_sets.h"
#include "partwise/parts/solid/convex_ridges.h"
#include "partwise/parts/solid/ridge_separation.h"

namespace partwise {
namespace {

// Rims are cut when the largest piece's concavity is at most this share of the whole's.
constexpr double kConcavityLeft = 0.8;
// Where the largest piece of a hollow part keeps more than this share of the faces, it is halved instead.
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

}  // namespace

std::vector<std::vector<int>> connected_groups(const Mesh& mesh, const std::vector<int>& faces) {
  DisjointSets sets(static_cast<std::size_t>(mesh.vertices.rows()));
  for (int f : faces) sets.join(mesh.faces(f, 0), mesh.faces(f, 1)), sets.join(mesh.faces(f, 1), mesh.faces(f, 2));
  std::vector<std::vector<int>> groups;
  std::vector<int> number(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  for (int f : faces) {
    int& group = number[sets.find(mesh.faces(f, 0))];
    if (group < 0) {
      group = static_cast<int>(groups.size());
      groups.emplace_back();
    }
    groups[group].push_back(f);
  }
  return groups;
}

namespace {

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

// Two pieces or more: the faces nearer to one end of the valley and those nearer to the other. The plane between them
// cuts both walls of a shell at the same place.
std::vector<std::vector<int>> halve(const Mesh& mesh, const PartGraph& part, const Valley& valley) {
  const int a = valley.path.front(), b = valley.path.back();
  const Point from = part.positions.row(a), to = part.positions.row(b);
  std::array<std::vector<int>, 2> sides;
  for (std::size_t f = 0; f < part.corners.size(); ++f) {
    const auto& corners = part.corners[f];
    double beyond = 0;
    for (int v : corners) beyond += (part.positions.row(v) - (from + to) / 2).dot(to - from);
    // No face has both ends: then the valley would run along its edge and not be deep.
    const bool at_a = std::count(corners.begin(), corners.end(), a) > 0;
    const bool at_b = std::count(corners.begin(), corners.end(), b) > 0;
    sides[at_b || (!at_a && beyond > 0)].push_back(part.faces[f]);
  }
  std::vector<std::vector<int>> groups;
  for (const auto& side : sides)
    for (auto& group : connected_groups(mesh, side)) groups.push_back(std::move(group));
  return groups;
}

const Valley& deepest_of(const std::vector<Valley>& valleys) {
  return *std::max_element(valleys.begin(), valleys.end(),
                           [](const Valley& x, const Valley& y) { return x.concavity < y.concavity; });
}

const std::vector<int>& largest_of(const std::vector<std::vector<int>>& groups) {
  return *std::max_element(groups.begin(), groups.end(),
                           [](const auto& x, const auto& y) { return x.size() < y.size(); });
}

}  // namespace

std::vector<std::vector<int>> separate_once(const Mesh& mesh, const SurfaceQuery& surface,
                                            const std::vector<int>& faces, double tolerance, const CupRepair& repair,
                                            double* concavity) {
  const PartGraph part = part_graph(mesh, faces);
  Bridges bridges = find_bridges(part, surface, tolerance, repair);
  if (concavity) *concavity = bridges.concavity;
  if (!bridges.deep.empty()) {
    std::vector<std::vector<int>> groups = separate(mesh, part, bridges, tolerance);
    // Ridges along the mouth of a hollow keep little more than the rim, and what is left is as hollow as before.
    const Valley& valley = deepest_of(bridges.deep);
    const bool crumbled =
        static_cast<double>(largest_of(groups).size()) > kFacesLeft * static_cast<double>(faces.size());
    if (repair.on && (groups.size() == 1 || (valley.through_hollow && crumbled))) return halve(mesh, part, valley);
    return groups;
  }
  if (bridges.rims.empty()) return {faces};
  // Rims alone: separate there if that makes them shallower.
  const double before = deepest_of(bridges.rims).concavity;
  bridges.deep = std::move(bridges.rims);
  std::vector<std::vector<int>> groups = separate(mesh, part, bridges, tolerance);
  const Bridges after = find_bridges(part_graph(mesh, largest_of(groups)), surface, tolerance, repair);
  double left = after.concavity;
  if (!after.rims.empty()) left = std::max(left, deepest_of(after.rims).concavity);
  if (left > kConcavityLeft * before) return {faces};
  return groups;
}

std::vector<ValleyPart> valley_decomposition(const Mesh& mesh, const SurfaceQuery& surface, std::vector<int> faces,
                                             double tolerance, const CupRepair& repair, const Progress& progress) {
  std::vector<ValleyPart> done;
  std::vector<std::vector<int>> open{std::move(faces)};
  const double total = static_cast<double>(open.front().size());
  double finished = 0;
  while (!open.empty()) {
    progress("convex ridges", finished / total);
    std::vector<int> current = std::move(open.back());
    open.pop_back();
    double concavity = 0;
    std::vector<std::vector<int>> split = separate_once(mesh, surface, current, tolerance, repair, &concavity);
    if (split.size() > 1) {
      for (auto& group : split) open.push_back(std::move(group));
    } else {
      finished += static_cast<double>(current.size());
      done.push_back({std::move(current), concavity});
    }
  }
  std::sort(done.begin(), done.end(),
            [](const ValleyPart& a, const ValleyPart& b) { return a.faces.front() < b.faces.front(); });
  return done;
}

}  // namespace partwise
