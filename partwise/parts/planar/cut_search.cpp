#include "partwise/parts/planar/cut_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace partwise {
namespace {

std::map<int, std::set<int>> features_by_diagonal(const CutProblem& problem, const std::vector<int>& resolvers) {
  std::map<int, std::set<int>> users;
  for (int r : resolvers) {
    for (int d : problem.resolvers[r].diagonals) users[d].insert(problem.resolvers[r].feature);
  }
  return users;
}

class Search {
 public:
  Search(const CutProblem& problem, const std::vector<int>& resolvers, int steps) : problem_(problem), steps_(steps) {
    const auto users = features_by_diagonal(problem, resolvers);
    std::map<int, int> names;
    for (int r : resolvers) {
      for (int f : problem.resolvers[r].resolves) names.try_emplace(f, static_cast<int>(names.size()));
    }
    covering_.resize(names.size());
    least_diagonals_.assign(names.size(), 1e300);
    most_score_.assign(names.size(), 0);
    for (int r : resolvers) {
      Item item{r, names[problem.resolvers[r].feature], {}, problem.resolvers[r].diagonals, problem.resolvers[r].score};
      double share = 0;  // of its diagonals, when all who can use them do
      for (int d : item.diagonals) share += 1.0 / static_cast<double>(users.at(d).size());
      for (int f : problem.resolvers[r].resolves) item.resolves.push_back(names[f]);
      for (int f : item.resolves) {
        covering_[f].push_back(static_cast<int>(items_.size()));
        least_diagonals_[f] = std::min(least_diagonals_[f], share / static_cast<double>(item.resolves.size()));
        most_score_[f] = std::max(most_score_[f], item.score);
      }
      items_.push_back(std::move(item));
    }
    covered_.assign(names.size(), 0), own_.assign(names.size(), false), skipped_.assign(names.size(), false);
  }

  std::optional<std::vector<int>> run() {
    descend(0, 0);
    if (steps_ < 0) return std::nullopt;
    std::vector<int> chosen;
    for (int i : best_) chosen.push_back(items_[i].resolver);
    std::sort(chosen.begin(), chosen.end());
    return chosen;
  }

 private:
  struct Item {
    int resolver, feature;
    std::vector<int> resolves, diagonals;
    double score;
  };

  bool fits(const Item& item) const {
    if (covered_[item.feature] > 0) return false;
    return std::none_of(item.resolves.begin(), item.resolves.end(), [&](int f) { return own_[f] || skipped_[f]; });
  }

  void descend(int skips, double score) {
    if (--steps_ < 0) return;
    double more_diagonals = 0, more_score = 0;
    int branch = -1;
    std::size_t fewest = 0;
    for (std::size_t f = 0; f < covering_.size(); ++f) {
      if (covered_[f] > 0 || skipped_[f]) continue;
      more_diagonals += used_.empty() ? least_diagonals_[f] : least_remaining(f);
      more_score += most_score_[f];
      const auto ways = static_cast<std::size_t>(
          std::count_if(covering_[f].begin(), covering_[f].end(), [&](int i) { return fits(items_[i]); }));
      if (branch < 0 || ways < fewest) branch = static_cast<int>(f), fewest = ways;
    }
    const int diagonals = static_cast<int>(used_.size()) + static_cast<int>(std::ceil(more_diagonals - 1e-9));
    const std::tuple bound(skips, diagonals, -(score + more_score));
    if (found_ && bound >= cost_) return;
    if (branch < 0) {
      cost_ = {skips, static_cast<int>(used_.size()), -score};
      best_ = chosen_, found_ = true;
      return;
    }
    std::vector<int> ways;
    for (int i : covering_[branch]) {
      if (fits(items_[i])) ways.push_back(i);
    }
    const auto fresh = [&](int i) {
      return std::count_if(items_[i].diagonals.begin(), items_[i].diagonals.end(),
                           [&](int d) { return !used_.contains(d); });
    };
    std::stable_sort(ways.begin(), ways.end(), [&](int a, int b) {
      return std::pair(fresh(a), -items_[a].score) < std::pair(fresh(b), -items_[b].score);
    });
    for (int i : ways) {
      take(i, 1);
      descend(skips, score + items_[i].score);
      take(i, -1);
    }
    skipped_[branch] = true;
    descend(skips + 1, score);
    skipped_[branch] = false;
  }

  // A diagonal in use costs no more; what is left of the least share.
  double least_remaining(std::size_t f) const {
    for (int i : covering_[f]) {
      for (int d : items_[i].diagonals) {
        if (used_.contains(d)) return 0;
      }
    }
    return least_diagonals_[f];
  }

  void take(int i, int sign) {
    const Item& item = items_[i];
    for (int f : item.resolves) covered_[f] += sign;
    own_[item.feature] = sign > 0;
    for (int d : item.diagonals) {
      int& count = used_[d];
      count += sign;
      if (count == 0) used_.erase(d);
    }
    sign > 0 ? chosen_.push_back(i) : chosen_.pop_back();
  }

  const CutProblem& problem_;
  int steps_;
  std::vector<Item> items_;
  std::vector<std::vector<int>> covering_;  // items of each feature
  std::vector<double> least_diagonals_, most_score_;
  std::vector<int> covered_;
  std::vector<bool> own_, skipped_;  // features whose own resolver is chosen; that stay unresolved
  std::map<int, int> used_;          // diagonals
  std::vector<int> chosen_, best_;
  std::tuple<int, int, double> cost_;
  bool found_ = false;
};

}  // namespace

std::vector<int> undominated_resolvers(const CutProblem& problem) {
  std::vector<int> all(problem.resolvers.size());
  for (std::size_t r = 0; r < all.size(); ++r) all[r] = static_cast<int>(r);
  const auto users = features_by_diagonal(problem, all);
  const auto own_diagonals = [&](const Resolver& resolver) {
    return std::count_if(resolver.diagonals.begin(), resolver.diagonals.end(),
                         [&](int d) { return users.at(d).size() == 1; });
  };
  // The best of each feature and set of features: fewest diagonals, then score.
  const auto better = [&](const Resolver& a, const Resolver& b) {
    return std::pair(a.diagonals.size(), -a.score) < std::pair(b.diagonals.size(), -b.score);
  };
  std::map<std::pair<int, std::vector<int>>, int> best;
  for (int r : all) {
    const Resolver& resolver = problem.resolvers[r];
    const auto [known, fresh] = best.try_emplace({resolver.feature, resolver.resolves}, r);
    if (!fresh && better(resolver, problem.resolvers[known->second])) known->second = r;
  }
  std::vector<int> kept;
  for (int r : all) {
    const Resolver& resolver = problem.resolvers[r];
    const int other = best.at({resolver.feature, resolver.resolves});
    const Resolver& least = problem.resolvers[other];
    const std::pair own(static_cast<std::size_t>(own_diagonals(resolver)), -resolver.score);
    if (other == r || own < std::pair(least.diagonals.size(), -least.score)) kept.push_back(r);
  }
  return kept;
}

std::optional<std::vector<int>> search_cuts(const CutProblem& problem, const std::vector<int>& resolvers, int steps) {
  return Search(problem, resolvers, steps).run();
}

}  // namespace partwise
