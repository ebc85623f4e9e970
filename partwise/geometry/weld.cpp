#include <bit>
#include <cmath>
#include <cstdint>

#include "partwise/base/error.h"
#include "partwise/base/splitmix.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

std::uint64_t hash(const Point& p) {
  std::uint64_t h = 0;
  for (const double x : p) h = splitmix(h + std::bit_cast<std::uint64_t>(x + 0.0) + splitmix_step);  // -0 + 0 is 0
  return h;
}

// The kept vertices by a key (their position, or the cell of a grid that they lie in): a hash table with open
// addressing over chains through the vertices of equal key.
class Kept {
 public:
  explicit Kept(Eigen::Index most)
      : table_(std::bit_ceil(2 * static_cast<std::size_t>(most) + 1), kNone), mask_(table_.size() - 1) {}

  // The first slot with this key, or a free one.
  std::size_t slot(const Point& key) const {
    std::size_t at = hash(key) & mask_;
    while (table_[at] != kNone && keys_[table_[at]] != key) at = (at + 1) & mask_;
    return at;
  }
  int head(std::size_t slot) const { return table_[slot]; }
  int next(int kept) const { return next_[kept]; }
  // Puts a further vertex at the head of a slot's chain; returns its number.
  int add(std::size_t slot, const Point& key) {
    const int number = static_cast<int>(keys_.size());
    keys_.push_back(key);
    next_.push_back(table_[slot]);
    table_[slot] = number;
    return number;
  }

  static constexpr int kNone = -1;

 private:
  std::vector<int> table_;
  std::size_t mask_;
  std::vector<Point> keys_;
  std::vector<int> next_;
};

// The lowest kept vertex within the tolerance of p, or kNone. Kept vertices are farther apart than the tolerance, so a
// cell holds few.
int find_near(const Kept& kept, const std::vector<Point>& positions, const Point& p, const Point& cell,
              double tolerance) {
  int nearest = Kept::kNone;
  for (int dx = -1; dx <= 1; ++dx)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dz = -1; dz <= 1; ++dz)
        for (int k = kept.head(kept.slot(cell + Point(dx, dy, dz))); k != Kept::kNone; k = kept.next(k))
          if ((positions[k] - p).norm() <= tolerance && (nearest == Kept::kNone || k < nearest)) nearest = k;
  return nearest;
}

}  // namespace

Mesh weld(const Mesh& mesh, double tolerance) {
  if (!(tolerance >= 0) || !std::isfinite(tolerance)) {
    throw InputError("weld tolerance", fmt::format("is {}", tolerance), "give a length of at least 0");
  }
  const Eigen::Index n = mesh.vertices.rows();
  const double largest = n > 0 ? mesh.vertices.cwiseAbs().maxCoeff() : 0;
  const bool exact = tolerance <= 1e-15 * largest || tolerance == 0;
  Kept kept(n);
  std::vector<Point> positions;
  std::vector<int> target(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point p = mesh.vertices.row(i);
    const Point key = exact ? p : Point((p / tolerance).array().floor().matrix());
    const std::size_t slot = kept.slot(key);
    int same = exact ? kept.head(slot) : find_near(kept, positions, p, key, tolerance);
    if (same == Kept::kNone) {
      same = kept.add(slot, key);
      positions.push_back(p);
    }
    target[i] = same;
  }
  Mesh welded{Vertices(static_cast<Eigen::Index>(positions.size()), 3), mesh.faces};
  for (std::size_t i = 0; i < positions.size(); ++i) welded.vertices.row(static_cast<Eigen::Index>(i)) = positions[i];
  for (int& v : welded.faces.reshaped()) v = target[v];
  return welded;
}

}  // namespace partwise
