#include "partwise/parts/surface/visibility_matrix.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace partwise {
namespace {

void put(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
  for (; number >= 128; number >>= 7) bytes.push_back(static_cast<std::uint8_t>(number | 128));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

std::uint32_t get(const std::vector<std::uint8_t>& bytes, std::size_t& at) {
  std::uint32_t number = 0;
  for (int shift = 0;; shift += 7) {
    const std::uint8_t byte = bytes[at++];
    number |= static_cast<std::uint32_t>(byte & 127) << shift;
    if (byte < 128) return number;
  }
}

}  // namespace

template <typename Visit>
void VisibilityMatrix::for_each_run(int row, const Visit& visit) const {
  const std::vector<std::uint8_t>& bytes = rows_[static_cast<std::size_t>(row)];
  int column = 0;
  for (std::size_t at = 0; at < bytes.size();) {
    const int first = column + static_cast<int>(get(bytes, at));
    column = first + static_cast<int>(get(bytes, at));
    if (!visit(first, column)) return;
  }
}

void VisibilityMatrix::set_row(int row, const std::vector<int>& members) {
  std::vector<std::uint8_t> bytes;
  int column = 0;
  for (std::size_t i = 0, j; i < members.size(); i = j) {
    for (j = i + 1; j < members.size() && members[j] == members[j - 1] + 1; ++j) {
    }
    put(bytes, static_cast<std::uint32_t>(members[i] - column));
    put(bytes, static_cast<std::uint32_t>(j - i));
    column = members[j - 1] + 1;
  }
  bytes.shrink_to_fit();
  rows_[static_cast<std::size_t>(row)] = std::move(bytes);
}

std::vector<int> VisibilityMatrix::row(int row) const {
  std::vector<int> members;
  for_each_run(row, [&](int first, int last) {
    for (int v = first; v < last; ++v) members.push_back(v);
    return true;
  });
  return members;
}

bool VisibilityMatrix::contains(int row, int column) const {
  bool found = false;
  for_each_run(row, [&](int first, int last) {
    found = first <= column && column < last;
    return last <= column;
  });
  return found;
}

std::size_t VisibilityMatrix::bytes() const {
  return std::accumulate(rows_.begin(), rows_.end(), std::size_t{0},
                         [](std::size_t sum, const auto& row) { return sum + row.size(); });
}

// By blocks of columns: the transposed block as bits, then each row of the block against its own transposed one.
VisibilityMatrix VisibilityMatrix::mutual() const {
  constexpr int kBlock = 2048;
  VisibilityMatrix result(size());
  const auto count = static_cast<std::size_t>(size());
  for (int begin = 0; begin < size(); begin += kBlock) {
    const int end = std::min(begin + kBlock, size());
    // seen_by[c]: the rows that hold column begin + c.
    std::vector<std::vector<bool>> seen_by(static_cast<std::size_t>(end - begin), std::vector<bool>(count, false));
    for (int r = 0; r < size(); ++r) {
      for_each_run(r, [&](int first, int last) {
        for (int c = std::max(first, begin); c < std::min(last, end); ++c)
          seen_by[static_cast<std::size_t>(c - begin)][static_cast<std::size_t>(r)] = true;
        return last < end;
      });
    }
    tbb::parallel_for(begin, end, [&](int v) {
      std::vector<int> both;
      for_each_run(v, [&](int first, int last) {
        for (int c = first; c < last; ++c)
          if (seen_by[static_cast<std::size_t>(v - begin)][static_cast<std::size_t>(c)]) both.push_back(c);
        return true;
      });
      result.set_row(v, both);
    });
  }
  return result;
}

}  // namespace partwise
