// Who sees whom: a square matrix of bits, each row a set of vertices, kept as runs. Vertices that are numbered along a
// space-filling curve make few runs: some bytes for each edge that the set's contour crosses.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace partwise {

class VisibilityMatrix {
 public:
  explicit VisibilityMatrix(int size) : rows_(static_cast<std::size_t>(size)) {}

  int size() const { return static_cast<int>(rows_.size()); }

  // `members`: ascending, each once. Rows may be set from several threads, each by one.
  void set_row(int row, const std::vector<int>& members);
  // Ascending.
  std::vector<int> row(int row) const;
  bool contains(int row, int column) const;
  std::size_t bytes() const;  // of all rows

  // The pairs that see each other: in the result (p, q) is there when here both (p, q) and (q, p) are.
  VisibilityMatrix mutual() const;

 private:
  // Calls visit(first, last) for every run [first, last) of a row, ascending, until it returns false.
  template <typename Visit>
  void for_each_run(int row, const Visit& visit) const;

  std::vector<std::vector<std::uint8_t>> rows_;  // lengths of gap, run, gap, run ..., seven bits a byte
};

}  // namespace partwise
