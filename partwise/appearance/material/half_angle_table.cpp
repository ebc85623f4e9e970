#include "partwise/appearance/material/half_angle_table.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <numbers>

namespace partwise {

double theta_h_of_row(int row) {
  const double h = (row + 0.5) / half_angle_rows;
  return h * h * std::numbers::pi / 2;
}

double theta_d_of_column(int column) { return (column + 0.5) / half_angle_columns * std::numbers::pi / 2; }

HalfAngleTable mean_over_phi(const MerlTable& table) {
  constexpr int bins = merl_theta_d_bins / half_angle_columns * merl_phi_d_bins;  // of the table in one of ours
  HalfAngleTable result;
  tbb::parallel_for(0, half_angle_rows, [&](int row) {
    for (int column = 0; column < half_angle_columns; ++column) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double cosine = 0;
      int count = 0;
      const int first = (row * half_angle_columns + column) * bins;
      for (int bin = first; bin < first + bins; ++bin) {
        const DirectionPair pair = directions_of(merl_centre(bin));
        if (!(pair.to_light.z() > 0 && pair.to_viewer.z() > 0) || !table.measured(bin)) continue;
        sum += table.value(bin);
        cosine += pair.to_light.z();
        ++count;
      }
      for (int channel = 0; channel < 3; ++channel)
        result.values[channel](row, column) = count ? sum[channel] / count : 0;
      result.cosine(row, column) = count ? cosine / count : 0;
    }
  });
  return result;
}

double log_rmse(const HalfAngleTable& measured, const HalfAngleTable& model) {
  double sum = 0;
  for (int channel = 0; channel < 3; ++channel) {
    const auto logs = [&](const HalfAngleTable& table) {
      return (table.values[channel] * measured.cosine + log_floor).log();
    };
    sum += (measured.cosine > 0).select(logs(measured) - logs(model), 0.0).square().sum();
  }
  return std::sqrt(sum / (3.0 * (measured.cosine > 0).count()));
}

double log_rmse(const HalfAngleTable& measured, const Brdf& model) {
  return log_rmse(measured, mean_over_phi(tabulate(model)));
}

}  // namespace partwise
