// Measured materials as the MERL database stores them (Matusik, Pfister, Brand, McMillan 2003, "A data-driven
// reflectance model"): a table over the angles of the half-vector, 90 x 90 x 180 bins of theta_h, theta_d and phi_d.
//
// Bins of theta_h are narrow near the mirror direction: bin i covers 90 sqrt(theta_h / (pi/2)) in [i, i + 1). Those of
// theta_d and phi_d are even, over [0, pi/2] and [0, pi); a negative phi_d counts as phi_d + pi, which reciprocity
// allows. Files (.binary) hold three 32-bit integers, 90 90 180, then 64-bit floats, little endian: all of red, of
// green, of blue, to be multiplied by 1/1500, 1.15/1500 and 1.66/1500. A negative value means that a direction is below
// the horizon or that nothing was measured.
//
// Values given and taken here are linear RGB in 1/sr, scaled. Errors: InputError for a file that cannot be read or
// written, is cut short or too long, has other bins, or holds a number that is not finite.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/appearance/material/brdf.h"

namespace partwise {

inline constexpr int merl_theta_h_bins = 90, merl_theta_d_bins = 90, merl_phi_d_bins = 180;
inline constexpr int merl_bins = merl_theta_h_bins * merl_theta_d_bins * merl_phi_d_bins;

// The bin that holds these angles, and the angles of its centre.
int merl_bin(const HalfAngles& angles);
HalfAngles merl_centre(int bin);

class MerlTable final : public Brdf {
 public:
  MerlTable();  // nothing measured

  // The nearest bin; zero where nothing was measured.
  Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const override;

  bool measured(int bin) const;  // no channel is negative
  Eigen::Vector3d value(int bin) const;
  void set(int bin, const Eigen::Vector3d& value);

  // As they stand in files: 3 x merl_bins, not scaled.
  const std::vector<double>& stored() const { return stored_; }

 private:
  friend MerlTable decode_merl(const std::string& file, std::string_view bytes);
  std::vector<double> stored_;
};

MerlTable read_merl(const std::filesystem::path& path);
// The same of bytes that are in memory; messages call them `file`.
MerlTable decode_merl(const std::string& file, std::string_view bytes);
// Atomic. What was read is written back byte for byte.
void write_merl(const std::filesystem::path& path, const MerlTable& table);

// Any material at the centres of the bins. Bins with a direction at or below the horizon are not measured.
MerlTable tabulate(const Brdf& brdf);

}  // namespace partwise
