#include "partwise/parts/planar/cut_selection.h"

#include <coin/Cbc_C_Interface.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>

#include "partwise/base/error.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/parts/planar/cut_search.h"

namespace partwise {
namespace {

bool contains(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

// Sparse rows of a programme, as CBC takes them by columns.
class Programme {
 public:
  int add_column(double cost) {
    cost_.push_back(cost);
    return static_cast<int>(cost_.size()) - 1;
  }
  void add_row(std::vector<std::pair<int, double>> entries, double low, double high) {
    rows_.push_back(std::move(entries));
    low_.push_back(low), high_.push_back(high);
  }

  // The columns that are 1 at the least cost.
  std::vector<bool> solve() const {
    const int columns = static_cast<int>(cost_.size());
    std::vector<std::vector<std::pair<int, double>>> by_column(cost_.size());
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      for (const auto& [column, value] : rows_[row]) by_column[column].emplace_back(static_cast<int>(row), value);
    }
    std::vector<CoinBigIndex> start{0};
    std::vector<int> index;
    std::vector<double> value;
    for (const auto& column : by_column) {
      for (const auto& [row, coefficient] : column) index.push_back(row), value.push_back(coefficient);
      start.push_back(static_cast<CoinBigIndex>(index.size()));
    }
    std::vector<double> zero, one;
    zero.resize(cost_.size());
    for (std::size_t i = 0; i < cost_.size(); ++i) one.push_back(1);
    static std::mutex only_one;  // CBC's solver keeps state of its own beyond the model.
    const std::lock_guard lock(only_one);
    Cbc_Model* model = Cbc_newModel();
    Cbc_setParameter(model, "logLevel", "0");
    Cbc_setParameter(model, "ratioGap", "0");
    Cbc_setParameter(model, "allowableGap", "0");
    Cbc_setParameter(model, "increment", "1e-9");
    Cbc_loadProblem(model, columns, static_cast<int>(rows_.size()), start.data(), index.data(), value.data(),
                    zero.data(), one.data(), cost_.data(), low_.data(), high_.data());
    for (int column = 0; column < columns; ++column) Cbc_setInteger(model, column);
    Cbc_solve(model);
    const bool optimal = Cbc_isProvenOptimal(model) != 0;
    std::vector<bool> chosen(cost_.size());
    if (optimal) {
      const double* solution = Cbc_getColSolution(model);
      for (int column = 0; column < columns; ++column) chosen[column] = solution[column] > 0.5;
    }
    Cbc_deleteModel(model);
    PARTWISE_CHECK(optimal, ==, true);
    return chosen;
  }

 private:
  std::vector<double> cost_, low_, high_;
  std::vector<std::vector<std::pair<int, double>>> rows_;
};

// Resolvers that may depend on each other: by conflicts, common diagonals or features.
std::vector<std::vector<int>> components(const CutProblem& problem, const std::vector<int>& resolvers) {
  const int n = static_cast<int>(problem.resolvers.size());
  DisjointSets sets(static_cast<std::size_t>(n + problem.features + problem.diagonals));
  for (int i : resolvers) {
    for (int feature : problem.resolvers[i].resolves) sets.join(i, n + feature);
    for (int diagonal : problem.resolvers[i].diagonals) sets.join(i, n + problem.features + diagonal);
  }
  for (const auto& [i, j] : problem.conflicts) sets.join(i, j);
  std::map<int, std::vector<int>> groups;
  for (int i : resolvers) groups[sets.find(i)].push_back(i);
  std::vector<std::vector<int>> result;
  result.reserve(groups.size());
  for (auto& [name, members] : groups) result.push_back(std::move(members));
  return result;
}

void solve_component(const CutProblem& problem, const std::vector<int>& members, std::vector<int>& chosen) {
  Programme programme;
  std::map<int, int> diagonal_column;
  std::map<int, std::vector<std::pair<int, double>>> cover, own;
  double scores = 1;
  for (int i : members) {
    const Resolver& resolver = problem.resolvers[i];
    scores += resolver.score;
    for (int diagonal : resolver.diagonals) diagonal_column[diagonal] = 0;
  }
  // A diagonal outweighs all scores, an unresolved feature all diagonals.
  const double heavy = static_cast<double>(diagonal_column.size()) + 2;
  for (int i : members) programme.add_column(-problem.resolvers[i].score / scores);
  for (auto& [diagonal, column] : diagonal_column) column = programme.add_column(1);
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Resolver& resolver = problem.resolvers[members[k]];
    const int column = static_cast<int>(k);
    for (int diagonal : resolver.diagonals) {
      programme.add_row({{column, 1}, {diagonal_column[diagonal], -1}}, -1, 0);
    }
    for (int feature : resolver.resolves) cover[feature].emplace_back(column, 1);
    own[resolver.feature].emplace_back(column, 1);
  }
  // Of the resolvers of a feature at most one, and none beside a resolver of another feature that resolves it too.
  for (const auto& [feature, columns] : own) {
    programme.add_row(columns, 0, 1);
    for (const auto& [column, one] : cover[feature]) {
      if (problem.resolvers[members[column]].feature == feature) continue;
      auto row = columns;
      row.emplace_back(column, one);
      programme.add_row(row, 0, 1);
    }
  }
  for (const auto& [i, j] : problem.conflicts) {
    const auto a = std::find(members.begin(), members.end(), i), b = std::find(members.begin(), members.end(), j);
    if (a == members.end() || b == members.end()) continue;
    programme.add_row({{static_cast<int>(a - members.begin()), 1}, {static_cast<int>(b - members.begin()), 1}}, 0, 1);
  }
  for (auto& [feature, entries] : cover) {
    entries.emplace_back(programme.add_column(heavy), 1);
    programme.add_row(entries, 1, static_cast<double>(entries.size()));
  }
  const std::vector<bool> solution = programme.solve();
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (solution[k]) chosen.push_back(members[k]);
  }
}

}  // namespace

bool in_conflict(const CutProblem& problem, int i, int j) {
  const Resolver &a = problem.resolvers[i], &b = problem.resolvers[j];
  if (contains(a.resolves, b.feature) || contains(b.resolves, a.feature)) return true;
  return std::any_of(problem.conflicts.begin(), problem.conflicts.end(),
                     [&](const auto& pair) { return pair == std::pair(i, j) || pair == std::pair(j, i); });
}

CutChoice select_cuts(const CutProblem& problem, int search_steps) {
  CutChoice choice;
  std::vector<int> resolvers(problem.resolvers.size());
  std::iota(resolvers.begin(), resolvers.end(), 0);
  const bool search = search_steps > 0 && problem.conflicts.empty();
  if (search) resolvers = undominated_resolvers(problem);
  for (const std::vector<int>& members : components(problem, resolvers)) {
    const auto found = search ? search_cuts(problem, members, search_steps) : std::nullopt;
    if (found) {
      choice.resolvers.insert(choice.resolvers.end(), found->begin(), found->end());
    } else {
      solve_component(problem, members, choice.resolvers);
    }
  }
  std::sort(choice.resolvers.begin(), choice.resolvers.end());
  std::vector<bool> resolved(static_cast<std::size_t>(problem.features));
  for (int i : choice.resolvers) {
    for (int feature : problem.resolvers[i].resolves) resolved[feature] = true;
  }
  for (int feature = 0; feature < problem.features; ++feature) {
    if (!resolved[feature]) choice.unresolved.push_back(feature);
  }
  return choice;
}

}  // namespace partwise
