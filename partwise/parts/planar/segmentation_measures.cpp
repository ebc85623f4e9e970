#include "partwise/parts/planar/segmentation_measures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "partwise/base/error.h"
#include "partwise/geometry/disjoint_sets.h"
#include "partwise/geometry/orientation.h"

namespace partwise {
namespace {

constexpr int samples = 4;  // a side of a cell

// Calls visit(column) for the sample columns of one row of sample points that lie in the polygon, by crossings.
template <typename Visit>
void scan(const Polygon& polygon, double y, double first_x, double step, int columns, Visit&& visit) {
  std::vector<double> crossings;
  const auto add = [&](const Ring& ring) {
    for (Eigen::Index i = 0, j = ring.rows() - 1; i < ring.rows(); j = i++) {
      const double y0 = ring(j, 1), y1 = ring(i, 1);
      if ((y0 > y) == (y1 > y)) continue;
      crossings.push_back(ring(j, 0) + (y - y0) / (y1 - y0) * (ring(i, 0) - ring(j, 0)));
    }
  };
  add(polygon.outer);
  for (const Ring& hole : polygon.holes) add(hole);
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
    const int from = std::max(0, static_cast<int>(std::ceil((crossings[k] - first_x) / step)));
    const int to = std::min(columns - 1, static_cast<int>(std::ceil((crossings[k + 1] - first_x) / step)) - 1);
    for (int column = from; column <= to; ++column) visit(column);
  }
}

CutLine ordered(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const bool a_first = a.x() != b.x() ? a.x() < b.x() : a.y() <= b.y();
  CutLine line;
  line << (a_first ? a : b), (a_first ? b : a);
  return line;
}

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

struct Clustering {
  std::vector<CutLine> centres;
  std::vector<int> owner;
  double cost = std::numeric_limits<double>::infinity();
};

int nearest(const std::vector<CutLine>& centres, const CutLine& line) {
  int best = 0;
  for (std::size_t c = 1; c < centres.size(); ++c) {
    if ((centres[c] - line).squaredNorm() < (centres[best] - line).squaredNorm()) best = static_cast<int>(c);
  }
  return best;
}

Clustering k_means(const std::vector<CutLine>& lines, std::size_t k, std::mt19937_64& random) {
  Clustering result;
  result.centres.push_back(lines[random() % lines.size()]);
  while (result.centres.size() < k) {  // k-means++ (Arthur, Vassilvitskii 2007)
    std::vector<double> sums;
    sums.reserve(lines.size());
    double sum = 0;
    for (const CutLine& line : lines) {
      sums.push_back(sum += (result.centres[nearest(result.centres, line)] - line).squaredNorm());
    }
    const auto at = std::upper_bound(sums.begin(), sums.end(), uniform(random) * sum) - sums.begin();
    result.centres.push_back(lines[std::min<std::size_t>(static_cast<std::size_t>(at), lines.size() - 1)]);
  }
  for (int round = 0; round < 100; ++round) {
    std::vector<int> owner;
    owner.reserve(lines.size());
    for (const CutLine& line : lines) owner.push_back(nearest(result.centres, line));
    if (owner == result.owner) break;
    result.owner = std::move(owner);
    std::vector<CutLine> sums(k, CutLine::Zero());
    std::vector<int> counts(k);
    for (std::size_t i = 0; i < lines.size(); ++i) sums[result.owner[i]] += lines[i], ++counts[result.owner[i]];
    for (std::size_t c = 0; c < k; ++c) {
      if (counts[c] > 0) result.centres[c] = sums[c] / counts[c];
    }
  }
  result.cost = 0;
  for (std::size_t i = 0; i < lines.size(); ++i)
    result.cost += (result.centres[result.owner[i]] - lines[i]).squaredNorm();
  return result;
}

}  // namespace

LabelGrid label_grid(std::span<const Polygon> parts, const Eigen::Vector2d& low, const Eigen::Vector2d& high, int size,
                     std::span<const int> owner) {
  LabelGrid grid;
  grid.size = size, grid.low = low, grid.cell = (high - low) / size;
  grid.labels.assign(static_cast<std::size_t>(size) * size, -1);
  const Eigen::Vector2d step = grid.cell / samples;
  std::vector<std::map<int, int>> counts(static_cast<std::size_t>(size));
  for (int row = 0; row < size; ++row) {
    for (auto& count : counts) count.clear();
    for (int line = 0; line < samples; ++line) {
      const double y = low.y() + (row * samples + line + 0.5) * step.y();
      for (std::size_t p = 0; p < parts.size(); ++p) {
        const int part = owner.empty() ? static_cast<int>(p) : owner[p];
        scan(parts[p], y, low.x() + 0.5 * step.x(), step.x(), size * samples,
             [&](int column) { ++counts[column / samples][part]; });
      }
    }
    for (int column = 0; column < size; ++column) {
      int all = 0, most = 0, label = -1;
      for (const auto& [part, count] : counts[column]) {
        all += count;
        if (count > most) most = count, label = part;
      }
      if (2 * all > samples * samples) grid.labels[static_cast<std::size_t>(row) * size + column] = label;
    }
  }
  return grid;
}

double rand_index(const LabelGrid& a, const LabelGrid& b) {
  PARTWISE_CHECK(a.labels.size(), ==, b.labels.size());
  std::map<std::pair<int, int>, double> both;
  std::map<int, double> in_a, in_b;
  double cells = 0;
  for (std::size_t i = 0; i < a.labels.size(); ++i) {
    if (a.labels[i] < 0 || b.labels[i] < 0) continue;
    ++both[{a.labels[i], b.labels[i]}], ++in_a[a.labels[i]], ++in_b[b.labels[i]], ++cells;
  }
  if (cells < 2) throw InputError("comparison", "the decompositions have no two cells in common", "compare one shape");
  const auto pairs = [](double n) { return n * (n - 1) / 2; };
  double together = 0, together_a = 0, together_b = 0;
  for (const auto& [labels, count] : both) together += pairs(count);
  for (const auto& [label, count] : in_a) together_a += pairs(count);
  for (const auto& [label, count] : in_b) together_b += pairs(count);
  return 1 - (together_a + together_b - 2 * together) / pairs(cells);
}

std::vector<CutLine> cut_lines(std::span<const Polygon> parts) {
  // Sides that two parts share, corner by corner, in either direction.
  using Key = std::array<double, 4>;
  std::map<Key, int> owners;
  struct Side {
    Eigen::Vector2d a, b;
  };
  std::map<std::pair<int, int>, std::vector<Side>> shared;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto add = [&](const Ring& ring) {
      for (Eigen::Index i = 0; i < ring.rows(); ++i) {
        const Eigen::Vector2d a = ring.row(i), b = ring.row((i + 1) % ring.rows());
        const auto other = owners.find({b.x(), b.y(), a.x(), a.y()});
        if (other != owners.end()) shared[{other->second, static_cast<int>(p)}].push_back({a, b});
        owners[{a.x(), a.y(), b.x(), b.y()}] = static_cast<int>(p);
      }
    };
    add(parts[p].outer);
    for (const Ring& hole : parts[p].holes) add(hole);
  }
  std::vector<CutLine> lines;
  for (const auto& [pair, sides] : shared) {
    // Sides that meet make one cut: its ends are the corners that only one side has.
    DisjointSets sets(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (sides[i].a == sides[j].b || sides[i].b == sides[j].a) sets.join(static_cast<int>(i), static_cast<int>(j));
      }
    }
    std::map<int, std::vector<Eigen::Vector2d>> ends;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      for (const Eigen::Vector2d& end : {sides[i].a, sides[i].b}) {
        auto& open = ends[sets.find(static_cast<int>(i))];
        const auto met = std::find(open.begin(), open.end(), end);
        met == open.end() ? open.push_back(end) : static_cast<void>(open.erase(met));
      }
    }
    for (const auto& [group, open] : ends) {
      if (open.size() == 2) lines.push_back(ordered(open[0], open[1]));
    }
  }
  return lines;
}

std::vector<CutCluster> cluster_cuts(std::span<const std::vector<CutLine>> decompositions, std::uint64_t seed) {
  std::vector<CutLine> lines;
  for (const auto& cuts : decompositions) lines.insert(lines.end(), cuts.begin(), cuts.end());
  if (lines.empty()) return {};
  const double mean = static_cast<double>(lines.size()) / static_cast<double>(decompositions.size());
  const auto k = std::clamp<std::size_t>(static_cast<std::size_t>(std::lround(mean)), 1, lines.size());
  std::mt19937_64 random(seed);
  Clustering best;
  for (int start = 0; start < 8; ++start) {
    Clustering one = k_means(lines, k, random);
    if (one.cost < best.cost) best = std::move(one);
  }
  std::vector<CutCluster> clusters(best.centres.size());
  std::vector<double> closest(clusters.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const int c = best.owner[i];
    const double distance = (lines[i] - best.centres[c]).norm();
    CutCluster& cluster = clusters[c];
    cluster.centre = best.centres[c];
    cluster.radius = std::max(cluster.radius, distance);
    ++cluster.members;
    if (distance < closest[c]) closest[c] = distance, cluster.representative = lines[i];
  }
  std::erase_if(clusters, [](const CutCluster& cluster) { return cluster.members == 0; });
  return clusters;
}

double cluster_coverage(std::span<const CutLine> cuts, std::span<const CutCluster> clusters, double least_radius) {
  std::vector<CutLine> centres;
  for (const CutCluster& cluster : clusters) centres.push_back(cluster.centre);
  std::vector<bool> met(clusters.size());
  for (const CutLine& cut : cuts) {
    if (clusters.empty()) break;
    const int c = nearest(centres, cut);
    if ((centres[c] - cut).norm() <= std::max(clusters[c].radius, least_radius)) met[c] = true;
  }
  double covered = 0, all = 0;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    all += clusters[c].members;
    if (met[c]) covered += clusters[c].members;
  }
  return all > 0 ? covered / all : 1;  // Nothing to cover is covered.
}

LabelGrid representative_grid(const LabelGrid& cells, std::span<const CutCluster> clusters) {
  const int n = cells.size;
  DisjointSets sets(cells.labels.size());
  const auto centre = [&](int x, int y) -> Eigen::Vector2d {
    return cells.low + cells.cell.cwiseProduct(Eigen::Vector2d(x + 0.5, y + 0.5));
  };
  const auto divided = [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
    return std::any_of(clusters.begin(), clusters.end(), [&](const CutCluster& cluster) {
      // Chords end on the boundary; half a cell more, so that the cells along it are divided too.
      Eigen::Vector2d a = cluster.representative.head<2>(), b = cluster.representative.tail<2>();
      const Eigen::Vector2d along = (b - a).normalized() * cells.cell.norm();
      a -= along, b += along;
      return orientation(a, b, p) * orientation(a, b, q) <= 0 && orientation(p, q, a) * orientation(p, q, b) <= 0;
    });
  };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const int here = y * n + x;
      if (cells.labels[here] < 0) continue;
      if (x + 1 < n && cells.labels[here + 1] >= 0 && !divided(centre(x, y), centre(x + 1, y)))
        sets.join(here, here + 1);
      if (y + 1 < n && cells.labels[here + n] >= 0 && !divided(centre(x, y), centre(x, y + 1)))
        sets.join(here, here + n);
    }
  }
  LabelGrid result = cells;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (result.labels[i] >= 0) result.labels[i] = sets.find(static_cast<int>(i));
  }
  return result;
}

}  // namespace partwise
