#include "partwise/parts/surface/maximum_matching.h"

#include <limits>
#include <utility>

#include "partwise/base/error.h"

namespace partwise {
namespace {

// Rows are matched one by one, at the least cost, which is minus the weight. Potentials u of rows and v of columns keep
// cost(i, j) - u_i - v_j >= 0, with 0 on matched pairs, so that the cheapest way to add a row is a shortest path. Row
// and column 0 are artificial; all others count from 1.
class Assignment {
 public:
  explicit Assignment(const Eigen::MatrixXd& weights)
      : weights_(weights),
        rows_(static_cast<int>(weights.rows())),
        columns_(static_cast<int>(weights.cols())),
        row_potential_(Eigen::VectorXd::Zero(rows_ + 1)),
        column_potential_(Eigen::VectorXd::Zero(columns_ + 1)),
        row_of_(static_cast<std::size_t>(columns_) + 1, 0) {
    for (int row = 1; row <= rows_; ++row) add(row);
  }

  // Of each column from 1 on, 0 for none.
  const std::vector<int>& row_of() const { return row_of_; }

 private:
  double reduced_cost(int row, int column) const {
    return -weights_(row - 1, column - 1) - row_potential_[row] - column_potential_[column];
  }

  void add(int row) {
    const double infinity = std::numeric_limits<double>::infinity();
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(columns_ + 1, infinity);
    std::vector<int> before(static_cast<std::size_t>(columns_) + 1, 0);
    std::vector<bool> done(static_cast<std::size_t>(columns_) + 1, false);
    row_of_[0] = row;
    int column = 0;
    do {
      done[column] = true;
      int next = 0;
      for (int k = 1; k <= columns_; ++k) {
        if (done[k]) continue;
        const double cost = reduced_cost(row_of_[column], k);
        if (cost < distance[k]) {
          distance[k] = cost;
          before[k] = column;
        }
        if (next == 0 || distance[k] < distance[next]) next = k;
      }
      shift(done, distance, distance[next]);
      column = next;
    } while (row_of_[column] != 0);
    for (; column != 0; column = before[column]) row_of_[column] = row_of_[before[column]];
  }

  // Makes the nearest column's reduced cost 0.
  void shift(const std::vector<bool>& done, Eigen::VectorXd& distance, double step) {
    for (int k = 0; k <= columns_; ++k) {
      if (done[k]) {
        row_potential_[row_of_[k]] += step;
        column_potential_[k] -= step;
      } else {
        distance[k] -= step;
      }
    }
  }

  const Eigen::MatrixXd& weights_;
  int rows_, columns_;
  Eigen::VectorXd row_potential_, column_potential_;
  std::vector<int> row_of_;
};

}  // namespace

Matching maximum_weight_matching(const Eigen::MatrixXd& weights) {
  if (!weights.allFinite() || (weights.array() < 0).any()) {
    throw InputError("weights", "one is negative or not finite", "give numbers from 0 up");
  }
  // No weight is negative, so that matching all of the shorter side is never worse than leaving some of it alone.
  const bool tall = weights.rows() > weights.cols();
  const Eigen::MatrixXd wide = tall ? Eigen::MatrixXd(weights.transpose()) : weights;
  const Assignment assignment(wide);
  Matching result;
  result.column_of_row.assign(static_cast<std::size_t>(weights.rows()), -1);
  for (int k = 1; k <= wide.cols(); ++k) {
    int row = assignment.row_of()[k] - 1, column = k - 1;
    if (row < 0) continue;
    if (tall) std::swap(row, column);
    result.column_of_row[row] = column;
  }
  for (int row = 0; row < weights.rows(); ++row) {
    if (result.column_of_row[row] >= 0) result.weight += weights(row, result.column_of_row[row]);
  }
  return result;
}

}  // namespace partwise
