#include "partwise/parts/planar/candidate_cuts.h"

#include <algorithm>
#include <map>
#include <set>

#include "partwise/parts/planar/resolvers.h"

namespace partwise {
namespace {

constexpr std::size_t most_resolvers = 12;  // of a feature: the best by score, singles and pairs each

class Chooser {
 public:
  Chooser(std::span<const Point2> points, const Region& region, const Complement& complement,
          const CutSettings& settings)
      : points_(points),
        complement_(complement),
        settings_(settings),
        mesh_(points, filled_rings(region, complement)) {}

  ChosenCuts choose() {
    find_features();
    add_simplified_diagonals();
    collect_candidates();
    collect_resolvers();
    const CutChoice choice = select_cuts(problem_);
    std::set<IndexEdge> chosen;
    for (int r : choice.resolvers) {
      for (int d : problem_.resolvers[r].diagonals) chosen.insert(diagonals_[d]);
    }
    const auto is_cut = [&](int a, int b) { return chosen.contains(sorted(mesh_.point(a), mesh_.point(b))); };
    return {{chosen.begin(), chosen.end()}, static_cast<int>(choice.unresolved.size()), mesh_.split(points_, is_cut)};
  }

 private:
  struct Feature {
    int vertex;
    Corner corner;
    std::vector<int> ends;  // of its candidate diagonals
  };

  static std::vector<const IndexRing*> filled_rings(const Region& region, const Complement& complement) {
    std::vector<const IndexRing*> rings{&region.outer};
    for (std::size_t h = 0; h < region.holes.size(); ++h) {
      if (!complement.noise[h]) rings.push_back(&region.holes[h]);
    }
    return rings;
  }

  // Features in the order of the simplified rings; those that are flat enough there need no resolver.
  void find_features() {
    for (const IndexRing& ring : complement_.simplified) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        if (!complement_.features.contains(ring[i]) || ring.size() < 2) continue;
        const int before = ring[(i + ring.size() - 1) % ring.size()], after = ring[(i + 1) % ring.size()];
        const Corner corner{points_[ring[i]], points_[after], points_[before]};
        if (!needs_resolver(corner, settings_.tolerance) || index_.contains(ring[i])) continue;
        index_[ring[i]] = static_cast<int>(features_.size());
        features_.push_back({ring[i], corner, {}});
      }
    }
  }

  bool same_pocket(int u, int v) const {
    const auto a = complement_.vertices.find(u), b = complement_.vertices.find(v);
    if (a == complement_.vertices.end() || b == complement_.vertices.end()) return false;
    for (int chamber : a->second.chambers) {
      if (std::binary_search(b->second.chambers.begin(), b->second.chambers.end(), chamber)) return true;
    }
    return false;
  }

  // Edges of the triangulation of the simplified polygon that are valid diagonals of the region become constraints.
  void add_simplified_diagonals() {
    std::vector<int> vertices;
    for (const IndexRing& ring : complement_.simplified) vertices.insert(vertices.end(), ring.begin(), ring.end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::vector<Point2> corners(vertices.size());
    std::transform(vertices.begin(), vertices.end(), corners.begin(), [&](int v) { return points_[v]; });
    const auto local = [&](int v) {
      return static_cast<int>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
    };
    ConstrainedDelaunay simplified(corners);
    for (const IndexRing& ring : complement_.simplified) {
      // Where the simplified polygon crosses itself, the edge that comes later is left out.
      for_each_edge(ring, [&](int a, int b) { simplified.insert_edge(local(a), local(b)); });
    }
    std::set<IndexEdge> edges;
    for (const auto& t : simplified.triangles()) {
      for (int i = 0; i < 3; ++i) {
        const int a = t.v[(i + 1) % 3], b = t.v[(i + 2) % 3];
        if (t.fixed[i] || std::max(a, b) >= simplified.point_count()) continue;
        const int p = vertices[a], q = vertices[b];
        if (index_.contains(p) || index_.contains(q)) edges.insert(sorted(p, q));
      }
    }
    for (const auto& [p, q] : edges) {
      if (same_pocket(p, q)) continue;
      const auto walk = mesh_.mesh().walk(mesh_.local(p), mesh_.local(q));
      if (walk.inside && walk.crossed.empty() && !walk.through_vertex) {
        mesh_.mesh().insert_edge(mesh_.local(p), mesh_.local(q));
      }
    }
  }

  void collect_candidates() {
    std::map<IndexEdge, int> names;
    for (Feature& feature : features_) {
      for (int end : mesh_.mesh().inside_neighbours(mesh_.local(feature.vertex))) {
        const int u = mesh_.point(end);
        if (same_pocket(feature.vertex, u)) continue;
        feature.ends.push_back(u);
        const auto [name, fresh] = names.try_emplace(sorted(feature.vertex, u), static_cast<int>(diagonals_.size()));
        if (fresh) diagonals_.push_back(name->first);
      }
      std::sort(feature.ends.begin(), feature.ends.end());
    }
    names_ = std::move(names);
    problem_.features = static_cast<int>(features_.size());
    problem_.diagonals = static_cast<int>(diagonals_.size());
  }

  std::vector<Point2> places(const std::vector<int>& vertices) const {
    std::vector<Point2> result;
    result.reserve(vertices.size());
    for (int v : vertices) result.push_back(points_[v]);
    return result;
  }

  Resolver resolver(int feature, const std::vector<int>& ends) const {
    Resolver result;
    result.feature = feature;
    const Feature& own = features_[feature];
    for (int u : ends) {
      result.diagonals.push_back(names_.at(sorted(own.vertex, u)));
      const auto far = complement_.vertices.find(u);
      const double concavity = far == complement_.vertices.end() ? 0 : far->second.value;
      result.score += diagonal_score((points_[u] - points_[own.vertex]).norm(), concavity, settings_) /
                      static_cast<double>(ends.size());
      // A single diagonal may resolve the feature at its other end as well.
      const auto other = index_.find(u);
      if (other == index_.end()) continue;
      const Point2 back[] = {points_[own.vertex]};
      if (partwise::resolves(features_[other->second].corner, back, settings_.tolerance)) {
        result.resolves.push_back(other->second);
      }
    }
    result.resolves.push_back(feature);
    std::sort(result.diagonals.begin(), result.diagonals.end());
    std::sort(result.resolves.begin(), result.resolves.end());
    result.resolves.erase(std::unique(result.resolves.begin(), result.resolves.end()), result.resolves.end());
    return result;
  }

  void collect_resolvers() {
    for (std::size_t f = 0; f < features_.size(); ++f) {
      const Feature& feature = features_[f];
      std::vector<Resolver> singles, pairs;
      for (const auto& set : smallest_resolvers(feature.corner, places(feature.ends), settings_.tolerance)) {
        std::vector<int> ends;
        ends.reserve(set.size());
        for (int i : set) ends.push_back(feature.ends[i]);
        (set.size() == 1 ? singles : pairs).push_back(resolver(static_cast<int>(f), ends));
      }
      for (auto* kind : {&singles, &pairs}) {
        std::stable_sort(kind->begin(), kind->end(), [](const Resolver& a, const Resolver& b) {
          if (a.resolves.size() != b.resolves.size()) return a.resolves.size() > b.resolves.size();
          return a.score > b.score;
        });
        if (kind->size() > most_resolvers) kind->resize(most_resolvers);
        problem_.resolvers.insert(problem_.resolvers.end(), kind->begin(), kind->end());
      }
    }
  }

  std::span<const Point2> points_;
  const Complement& complement_;
  CutSettings settings_;
  RegionMesh mesh_;
  std::vector<Feature> features_;
  std::unordered_map<int, int> index_;  // of a vertex among the features
  std::vector<IndexEdge> diagonals_;
  std::map<IndexEdge, int> names_;
  CutProblem problem_;
};

}  // namespace

double diagonal_score(double length, double far_concavity, const CutSettings& settings) {
  return (1 + far_concavity / settings.tolerance) * settings.radius / length;
}

ChosenCuts choose_cuts(std::span<const Point2> points, const Region& region, const Complement& complement,
                       const CutSettings& settings) {
  return Chooser(points, region, complement, settings).choose();
}

}  // namespace partwise
