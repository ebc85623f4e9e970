#include "partwise/parts/solid/part_graph.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>

#include "partwise/geometry/disjoint_sets.h"

namespace partwise {
namespace {

// The straight distance between corners p and q across their shared edge (a, b) once the two faces lie in one plane;
// nothing where the line would leave the faces.
std::optional<double> unfolded_diagonal(const Point& a, const Point& b, const Point& p, const Point& q) {
  const double edge = (b - a).norm();
  if (edge == 0) return {};
  const Point along = (b - a) / edge;
  const double xp = (p - a).dot(along), xq = (q - a).dot(along);
  const double yp = (p - a - xp * along).norm(), yq = (q - a - xq * along).norm();
  if (yp + yq == 0) return {};
  const double crossing = (xp * yq + xq * yp) / (yp + yq);
  if (crossing <= 0 || crossing >= edge) return {};
  return std::hypot(xp - xq, yp + yq);
}

// Half-edges by their lower vertex, through counting; those of one vertex by the higher, then by face.
struct HalfEdges {
  struct HalfEdge {
    int high, face, opposite;
  };
  std::vector<int> first;  // by lower vertex
  std::vector<HalfEdge> list;

  explicit HalfEdges(const PartGraph& part) : first(part.vertices.size() + 1, 0) {
    for (const auto& c : part.corners)
      for (int k = 0; k < 3; ++k)
        if (c[k] != c[(k + 1) % 3]) ++first[std::min(c[k], c[(k + 1) % 3]) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    list.resize(static_cast<std::size_t>(first.back()));
    std::vector<int> end(first.begin(), first.end() - 1);
    for (int f = 0; f < static_cast<int>(part.corners.size()); ++f) {
      const auto& c = part.corners[f];
      for (int k = 0; k < 3; ++k) {
        const auto [low, high] = std::minmax(c[k], c[(k + 1) % 3]);
        if (low != high) list[end[low]++] = {high, f, c[(k + 2) % 3]};
      }
    }
    for (int v = 0; v < part.size(); ++v) {
      std::sort(list.begin() + first[v], list.begin() + first[v + 1], [](const HalfEdge& x, const HalfEdge& y) {
        return x.high != y.high ? x.high < y.high : x.face < y.face;
      });
    }
  }

  // Calls visit(half-edges of an edge) for the edges whose lower vertex is v.
  template <typename Visit>
  void for_each_edge(int v, const Visit& visit) const {
    for (int i = first[v], j; i < first[v + 1]; i = j) {
      j = i + 1;
      while (j < first[v + 1] && list[j].high == list[i].high) ++j;
      visit(std::span(list).subspan(i, j - i));
    }
  }
};

}  // namespace

PartGraph part_graph(const Mesh& mesh, std::span<const int> faces) {
  PartGraph part;
  part.faces.assign(faces.begin(), faces.end());
  std::vector<int> local(static_cast<std::size_t>(mesh.vertices.rows()), -1);
  for (int f : faces)
    for (int k = 0; k < 3; ++k) local[mesh.faces(f, k)] = 0;
  for (std::size_t v = 0; v < local.size(); ++v) {
    if (local[v] < 0) continue;
    local[v] = part.size();
    part.vertices.push_back(static_cast<int>(v));
  }
  part.positions = mesh.vertices(part.vertices, Eigen::all);

  part.corners.reserve(faces.size());
  for (int f : faces)
    part.corners.push_back({local[mesh.faces(f, 0)], local[mesh.faces(f, 1)], local[mesh.faces(f, 2)]});
  const HalfEdges half_edges(part);

  struct Link {
    int a, b;
    double length;
  };
  std::vector<Link> links;
  links.reserve(half_edges.list.size());
  const auto add_edge = [&](int a, std::span<const HalfEdges::HalfEdge> sides) {
    const int b = sides.front().high;
    const Point pa = part.positions.row(a), pb = part.positions.row(b);
    links.push_back({a, b, (pa - pb).norm()});
    for (std::size_t j = 1; j < sides.size(); ++j) {
      const HalfEdges::HalfEdge &e = sides[j - 1], &next = sides[j];
      if (e.face == next.face) continue;
      part.shared.push_back({e.face, next.face, a, b});
      if (e.opposite == next.opposite) continue;
      const auto diagonal =
          unfolded_diagonal(pa, pb, part.positions.row(e.opposite), part.positions.row(next.opposite));
      if (diagonal) links.push_back({e.opposite, next.opposite, *diagonal});
    }
  };
  for (int v = 0; v < part.size(); ++v) half_edges.for_each_edge(v, [&](const auto& sides) { add_edge(v, sides); });
  part.first.assign(part.vertices.size() + 1, 0);
  for (const Link& l : links) ++part.first[l.a + 1], ++part.first[l.b + 1];
  for (std::size_t v = 0; v < part.vertices.size(); ++v) part.first[v + 1] += part.first[v];
  part.steps.resize(2 * links.size());
  std::vector<int> next(part.first.begin(), part.first.end() - 1);
  for (const Link& l : links) {
    part.steps[next[l.a]++] = {l.b, l.length};
    part.steps[next[l.b]++] = {l.a, l.length};
  }
  return part;
}

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

PathSearch::PathSearch(const PartGraph& graph)
    : graph_(graph), distance_(graph.first.size()), previous_(graph.first.size()), seen_(graph.first.size(), 0) {
  constexpr double kMostBuckets = 1024;
  double sum = 0, longest = 0;
  for (const auto& step : graph.steps) sum += step.length, longest = std::max(longest, step.length);
  if (longest > 0) width_ = std::max(0.5 * sum / static_cast<double>(graph.steps.size()), longest / kMostBuckets);
  ring_.resize(static_cast<std::size_t>(longest / width_) + 2);
}

void PathSearch::begin() { ++round_; }

bool PathSearch::relax(int v, double distance, int previous) {
  if (seen_[v] == round_ && distance_[v] <= distance) return false;
  seen_[v] = round_;
  distance_[v] = distance;
  previous_[v] = previous;
  return true;
}

namespace {
using Queued = std::pair<double, int>;
using Queue = std::priority_queue<Queued, std::vector<Queued>, std::greater<>>;
}  // namespace

double PathSearch::bounded_length(int a, int b, double at_most) {
  begin();
  const Point goal = graph_.positions.row(b);
  const auto ahead = [&](int v) { return (graph_.positions.row(v) - goal).norm(); };
  Queue queue;
  relax(a, 0, -1);
  queue.push({ahead(a), a});
  while (!queue.empty()) {
    const auto [key, v] = queue.top();
    queue.pop();
    if (v == b) return distance_[b];
    const double here = distance_[v];
    if (key > here + ahead(v) + 1e-12) continue;  // A shorter way was found since.
    for (int i = graph_.first[v]; i < graph_.first[v + 1]; ++i) {
      const auto [w, length] = graph_.steps[i];
      const double distance = here + length;
      const double least = distance + ahead(w);
      if (least <= at_most && relax(w, distance, v)) queue.push({least, w});
    }
  }
  return std::numeric_limits<double>::infinity();
}

// Paths that lead towards b are tried first; one that is longer than need be is taken again where it gets shorter.
bool PathSearch::has_path(int a, int b, double at_most) {
  if (a == b) return true;
  begin();
  const Point goal = graph_.positions.row(b);
  constexpr double kHaste = 2;  // of the straight way ahead, against the way behind
  relax(a, 0, -1);
  heap_.assign(1, {0, a});
  while (!heap_.empty()) {
    const int v = heap_.front().second;
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    heap_.pop_back();
    for (int i = graph_.first[v]; i < graph_.first[v + 1]; ++i) {
      const auto [w, length] = graph_.steps[i];
      const double distance = distance_[v] + length;
      const double ahead = (graph_.positions.row(w) - goal).norm();
      if (distance + ahead > at_most || !relax(w, distance, v)) continue;
      if (w == b) return true;
      heap_.emplace_back(kHaste * ahead + distance, w);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }
  return false;
}

void PathSearch::from(int source, std::span<const int> targets) {
  begin();
  std::vector<int> missing(targets.begin(), targets.end());
  const auto bucket_of = [&](double distance) { return static_cast<std::size_t>(distance / width_); };
  relax(source, 0, -1);
  ring_.front().emplace_back(0, source);
  std::size_t queued = 1;
  for (std::size_t at = 0; queued > 0; ++at) {
    auto& bucket = ring_[at % ring_.size()];
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // NOLINT(modernize-loop-convert): it may grow.
      const auto [distance, v] = bucket[i];
      if (distance > distance_[v]) continue;  // A shorter way was found since.
      for (int s = graph_.first[v]; s < graph_.first[v + 1]; ++s) {
        const auto [w, length] = graph_.steps[s];
        if (!relax(w, distance + length, v)) continue;
        ring_[bucket_of(distance_[w]) % ring_.size()].emplace_back(distance_[w], w);
        ++queued;
      }
    }
    queued -= bucket.size();
    bucket.clear();
    std::erase_if(missing, [&](int v) { return seen_[v] == round_ && bucket_of(distance_[v]) <= at; });
    if (missing.empty()) break;
  }
  for (auto& bucket : ring_) bucket.clear();
}

std::vector<int> PathSearch::path_to(int target) const {
  std::vector<int> path;
  if (seen_[target] != round_) return path;
  for (int v = target; v >= 0; v = previous_[v]) path.push_back(v);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<double> PathSearch::within_reach(std::span<const std::pair<int, double>> sources) {
  begin();
  std::vector<double> result(static_cast<std::size_t>(graph_.size()), 0.0);
  Queue queue;
  for (const auto& [v, reach] : sources)
    if (relax(v, -reach, -1)) queue.push({-reach, v});
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value > distance_[v]) continue;
    result[v] = value;
    for (int i = graph_.first[v]; i < graph_.first[v + 1]; ++i) {
      const auto [w, length] = graph_.steps[i];
      const double next = value + length;
      if (next < 0 && relax(w, next, v)) queue.push({next, w});
    }
  }
  return result;
}

}  // namespace partwise
