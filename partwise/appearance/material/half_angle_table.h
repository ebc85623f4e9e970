// What a fit sees of a measured material: means over phi_d, on a grid of theta_h and theta_d. Models of the half-vector
// have no phi_d, and measured ones hardly depend on it.
//
// 90 bins of theta_h as in merl.h by 45 even ones of theta_d, values linear RGB in 1/sr.
#pragma once

#include <Eigen/Core>

#include <array>

#include "partwise/appearance/material/merl.h"

namespace partwise {

inline constexpr int half_angle_rows = merl_theta_h_bins, half_angle_columns = 45;

using HalfAngleArray = Eigen::Array<double, half_angle_rows, half_angle_columns>;

double theta_h_of_row(int row);        // centre of the bin
double theta_d_of_column(int column);  // centre of the bin

struct HalfAngleTable {
  std::array<HalfAngleArray, 3> values;  // by channel; 0 where cosine is 0
  HalfAngleArray cosine;                 // mean cosine of the light; 0 where nothing was measured
};

HalfAngleTable mean_over_phi(const MerlTable& table);

// What the eye compares: log(f cos + 0.001), whose differences are relative ones until it is dark.
inline constexpr double log_floor = 1e-3;

// Root mean square over channels and all bins that `measured` has of the difference of log(f cos + 0.001).
double log_rmse(const HalfAngleTable& measured, const HalfAngleTable& model);
double log_rmse(const HalfAngleTable& measured, const Brdf& model);

}  // namespace partwise
