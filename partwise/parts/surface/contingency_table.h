// How two labellings of the same items overlap: the cells of their contingency table that are not empty, and the sums
// of its rows and columns. Items are faces with a weight, their area. Time and space linear in the items.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace partwise {

struct Overlap {
  std::int64_t count = 0;
  double area = 0;
};

struct ContingencyTable {
  struct Cell : Overlap {
    int row = 0, column = 0;  // segments, numbered in the order of their first face
  };

  std::vector<Cell> cells;  // in the order of their first face, so that nothing depends on what labels are called
  std::vector<Overlap> rows, columns;
};

// Both labellings and the areas have one entry a face.
ContingencyTable contingency_table(std::span<const int> row_labels, std::span<const int> column_labels,
                                   std::span<const double> areas);

// Share of the pairs of faces that one labelling puts together and the other apart; 0 for fewer than two faces.
double rand_error(const ContingencyTable& table);

// Share of the area that lies outside the best match, for rows (each with its best column) and for columns.
struct Unmatched {
  double rows = 0, columns = 0;
};
Unmatched unmatched_area(const ContingencyTable& table);

// Mean refinement errors (Martin et al. 2001): in the better direction, and of each face's better direction.
struct Consistency {
  double global = 0, local = 0;
};
Consistency consistency_error(const ContingencyTable& table);

}  // namespace partwise
