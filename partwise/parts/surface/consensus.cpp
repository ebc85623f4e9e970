#include "partwise/parts/surface/consensus.h"

#include <fmt/format.h>

#include <Eigen/Core>

#include <algorithm>
#include <map>
#include <numeric>

#include "partwise/base/error.h"

namespace partwise {
namespace {

struct Atoms {
  std::vector<int> of;                   // atom of each face
  std::vector<std::vector<int>> labels;  // of each atom, in each segmentation
  std::vector<double> faces;             // how many
};

Atoms common_pieces(std::span<const std::vector<int>> segmentations) {
  Atoms atoms;
  std::map<std::vector<int>, int> number;
  std::vector<int> key(segmentations.size());
  for (std::size_t f = 0; f < segmentations.front().size(); ++f) {
    for (std::size_t s = 0; s < key.size(); ++s) key[s] = segmentations[s][f];
    const auto [entry, is_new] = number.try_emplace(key, static_cast<int>(atoms.faces.size()));
    if (is_new) {
      atoms.labels.push_back(key);
      atoms.faces.push_back(0);
    }
    ++atoms.faces[entry->second];
    atoms.of.push_back(entry->second);
  }
  return atoms;
}

double closeness(const std::vector<int>& a, const std::vector<int>& b) {
  int together = 0;
  for (std::size_t s = 0; s < a.size(); ++s) together += a[s] == b[s];
  return static_cast<double>(together) / static_cast<double>(a.size());
}

// Average linkage among atoms; group[i] is the first member of the group of chosen[i], as a place in `chosen`.
std::vector<int> merge_groups(const Atoms& atoms, const std::vector<int>& chosen, double agreement) {
  const auto count = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd close(count, count);
  Eigen::VectorXd weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    weight[i] = atoms.faces[chosen[i]];
    for (Eigen::Index j = 0; j < i; ++j)
      close(i, j) = close(j, i) = closeness(atoms.labels[chosen[i]], atoms.labels[chosen[j]]);
    close(i, i) = -1;
  }
  std::vector<int> group(chosen.size());
  std::iota(group.begin(), group.end(), 0);
  for (;;) {
    Eigen::Index a = 0, b = 0;
    if (count == 0 || !(close.maxCoeff(&a, &b) > agreement)) return group;
    if (b < a) std::swap(a, b);
    const double share = weight[a] / (weight[a] + weight[b]);
    for (Eigen::Index i = 0; i < count; ++i)
      if (close(i, a) >= 0) close(i, a) = close(a, i) = share * close(i, a) + (1 - share) * close(i, b);
    close.col(b).setConstant(-1), close.row(b).setConstant(-1);
    weight[a] += weight[b];
    for (int& g : group)
      if (g == static_cast<int>(b)) g = static_cast<int>(a);
  }
}

}  // namespace

std::vector<int> consensus_labels(std::span<const std::vector<int>> segmentations, const ConsensusSettings& settings) {
  if (segmentations.empty()) throw InputError("segmentations", "there are none", "give at least one");
  for (const auto& labels : segmentations) {
    if (labels.size() == segmentations.front().size()) continue;
    throw InputError("segmentations",
                     fmt::format("one has {} labels, another {}", segmentations.front().size(), labels.size()),
                     "give segmentations of the same faces");
  }
  if (!(settings.agreement >= 0 && settings.agreement <= 1)) {
    throw InputError("agreement", fmt::format("{} is out of range", settings.agreement), "give a share from 0 to 1");
  }
  const Atoms atoms = common_pieces(segmentations);
  std::vector<int> order(atoms.faces.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return atoms.faces[a] > atoms.faces[b]; });
  const std::size_t most = std::min(order.size(), static_cast<std::size_t>(std::max(1, settings.largest_atoms)));
  const std::vector<int> chosen(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most));
  const std::vector<int> group = merge_groups(atoms, chosen, settings.agreement);

  std::vector<int> of_atom(atoms.faces.size());
  for (std::size_t i = 0; i < most; ++i) of_atom[chosen[i]] = group[i];
  std::vector<double> total(most, 0.0), mean(most);
  for (std::size_t i = 0; i < most; ++i) total[group[i]] += atoms.faces[chosen[i]];
  for (std::size_t rest = most; rest < order.size(); ++rest) {
    std::fill(mean.begin(), mean.end(), 0.0);
    for (std::size_t i = 0; i < most; ++i)
      mean[group[i]] += atoms.faces[chosen[i]] * closeness(atoms.labels[order[rest]], atoms.labels[chosen[i]]);
    int best = -1;
    for (std::size_t g = 0; g < most; ++g) {
      if (total[g] > 0) mean[g] /= total[g];
      if (total[g] > 0 && (best < 0 || mean[g] > mean[best])) best = static_cast<int>(g);
    }
    of_atom[order[rest]] = best;
  }
  std::vector<int> labels, number(most, -1);
  int next = 0;
  for (int atom : atoms.of) {
    int& label = number[of_atom[atom]];
    if (label < 0) label = next++;
    labels.push_back(label);
  }
  return labels;
}

}  // namespace partwise
