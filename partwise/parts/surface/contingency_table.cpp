#include "partwise/parts/surface/contingency_table.h"

#include <algorithm>
#include <unordered_map>

namespace partwise {
namespace {

// Numbers from 0, in the order in which they first appear.
std::vector<int> renumbered(std::span<const int> labels) {
  std::unordered_map<int, int> numbers;
  std::vector<int> result;
  result.reserve(labels.size());
  for (const int label : labels)
    result.push_back(numbers.try_emplace(label, static_cast<int>(numbers.size())).first->second);
  return result;
}

void add(std::vector<Overlap>& sums, int segment, double area) {
  if (segment == static_cast<int>(sums.size())) sums.emplace_back();
  ++sums[segment].count;
  sums[segment].area += area;
}

double total_area(const std::vector<Overlap>& segments) {
  double total = 0;
  for (const Overlap& segment : segments) total += segment.area;
  return total;
}

std::int64_t ordered_pairs(std::int64_t count) { return count * (count - 1); }

std::int64_t ordered_pairs(const std::vector<Overlap>& segments) {
  std::int64_t pairs = 0;
  for (const Overlap& segment : segments) pairs += ordered_pairs(segment.count);
  return pairs;
}

// What part of a segment does not lie in the cell. Segments without area lie wholly in any.
double share_outside(const ContingencyTable::Cell& cell, const Overlap& segment) {
  return segment.area > 0 ? std::max(0.0, 1 - cell.area / segment.area) : 0;
}

}  // namespace

ContingencyTable contingency_table(std::span<const int> row_labels, std::span<const int> column_labels,
                                   std::span<const double> areas) {
  const std::vector<int> rows = renumbered(row_labels), columns = renumbered(column_labels);
  ContingencyTable table;
  std::unordered_map<std::uint64_t, std::size_t> places;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    add(table.rows, rows[i], areas[i]);
    add(table.columns, columns[i], areas[i]);
    const std::uint64_t key = static_cast<std::uint64_t>(rows[i]) << 32 | static_cast<std::uint64_t>(columns[i]);
    const auto [place, is_new] = places.try_emplace(key, table.cells.size());
    if (is_new) table.cells.push_back({{}, rows[i], columns[i]});
    ++table.cells[place->second].count;
    table.cells[place->second].area += areas[i];
  }
  return table;
}

double rand_error(const ContingencyTable& table) {
  std::int64_t faces = 0, together_in_both = 0;
  for (const ContingencyTable::Cell& cell : table.cells) {
    faces += cell.count;
    together_in_both += ordered_pairs(cell.count);
  }
  if (faces < 2) return 0;
  const std::int64_t only_rows = ordered_pairs(table.rows) - together_in_both;
  const std::int64_t only_columns = ordered_pairs(table.columns) - together_in_both;
  return (static_cast<double>(only_rows) + static_cast<double>(only_columns)) /
         static_cast<double>(ordered_pairs(faces));
}

Unmatched unmatched_area(const ContingencyTable& table) {
  std::vector<double> best_of_row(table.rows.size(), 0), best_of_column(table.columns.size(), 0);
  for (const ContingencyTable::Cell& cell : table.cells) {
    best_of_row[cell.row] = std::max(best_of_row[cell.row], cell.area);
    best_of_column[cell.column] = std::max(best_of_column[cell.column], cell.area);
  }
  // Summed by segment, not as total less matched, so that nothing unmatched is exactly 0.
  Unmatched unmatched;
  for (std::size_t i = 0; i < best_of_row.size(); ++i) unmatched.rows += table.rows[i].area - best_of_row[i];
  for (std::size_t i = 0; i < best_of_column.size(); ++i) {
    unmatched.columns += table.columns[i].area - best_of_column[i];
  }
  const double total = total_area(table.rows);
  return {unmatched.rows / total, unmatched.columns / total};
}

Consistency consistency_error(const ContingencyTable& table) {
  double by_rows = 0, by_columns = 0, by_better = 0;
  std::int64_t faces = 0;
  for (const ContingencyTable::Cell& cell : table.cells) {
    const double of_row = share_outside(cell, table.rows[cell.row]);
    const double of_column = share_outside(cell, table.columns[cell.column]);
    const double count = static_cast<double>(cell.count);
    by_rows += count * of_row;
    by_columns += count * of_column;
    by_better += count * std::min(of_row, of_column);
    faces += cell.count;
  }
  const double all = static_cast<double>(faces);
  return {std::min(by_rows, by_columns) / all, by_better / all};
}

}  // namespace partwise
