#include "partwise/appearance/material/merl.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/bytes.h"

namespace partwise {
namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr std::array<double, 3> kScales = {1 / 1500.0, 1.15 / 1500, 1.66 / 1500};
constexpr std::size_t kHeader = 3 * sizeof(std::int32_t);
constexpr std::size_t kFile = kHeader + 3 * sizeof(double) * merl_bins;

int clamped(double bin, int bins) { return static_cast<int>(std::clamp(std::floor(bin), 0.0, bins - 1.0)); }

std::size_t offset(int channel, int bin) {
  return static_cast<std::size_t>(channel) * merl_bins + static_cast<std::size_t>(bin);
}

}  // namespace

int merl_bin(const HalfAngles& angles) {
  const int h = clamped(merl_theta_h_bins * std::sqrt(std::max(angles.theta_h, 0.0) / kQuarter), merl_theta_h_bins);
  const int d = clamped(merl_theta_d_bins * angles.theta_d / kQuarter, merl_theta_d_bins);
  const double phi = angles.phi_d < 0 ? angles.phi_d + std::numbers::pi : angles.phi_d;
  const int p = clamped(merl_phi_d_bins * phi / std::numbers::pi, merl_phi_d_bins);
  return (h * merl_theta_d_bins + d) * merl_phi_d_bins + p;
}

HalfAngles merl_centre(int bin) {
  const int p = bin % merl_phi_d_bins, row = bin / merl_phi_d_bins;
  const int d = row % merl_theta_d_bins, steps = row / merl_theta_d_bins;
  const double h = (steps + 0.5) / merl_theta_h_bins;
  return {h * h * kQuarter, (d + 0.5) / merl_theta_d_bins * kQuarter, (p + 0.5) / merl_phi_d_bins * std::numbers::pi};
}

MerlTable::MerlTable() : stored_(3 * static_cast<std::size_t>(merl_bins), -1.0) {}

bool MerlTable::measured(int bin) const {
  return stored_[offset(0, bin)] >= 0 && stored_[offset(1, bin)] >= 0 && stored_[offset(2, bin)] >= 0;
}

Eigen::Vector3d MerlTable::value(int bin) const {
  Eigen::Vector3d result;
  for (int channel = 0; channel < 3; ++channel) result[channel] = kScales[channel] * stored_[offset(channel, bin)];
  return result;
}

void MerlTable::set(int bin, const Eigen::Vector3d& value) {
  for (int channel = 0; channel < 3; ++channel) stored_[offset(channel, bin)] = value[channel] / kScales[channel];
}

Eigen::Vector3f MerlTable::operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const {
  if (!(to_light.z() > 0 && to_viewer.z() > 0)) return Eigen::Vector3f::Zero();
  const int bin = merl_bin(half_angles(to_light.cast<double>(), to_viewer.cast<double>()));
  if (!measured(bin)) return Eigen::Vector3f::Zero();
  return value(bin).cast<float>();
}

MerlTable decode_merl(const std::string& file, std::string_view bytes) {
  const char* const remedy = "give a .binary file of the MERL database";
  const std::array<std::int32_t, 3> expected = {merl_theta_h_bins, merl_theta_d_bins, merl_phi_d_bins};
  if (bytes.size() < kHeader)
    throw InputError(file, fmt::format("is too short for a MERL table ({} bytes)", bytes.size()), remedy);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto bins = load<std::int32_t>(bytes.data() + i * sizeof(std::int32_t));
    if (bins != expected[i]) {
      throw InputError(file,
                       fmt::format("is no MERL table: number {} of its header is {}, not {}", i + 1, bins, expected[i]),
                       remedy);
    }
  }
  if (bytes.size() != kFile) {
    throw InputError(file, fmt::format("has {} bytes where a MERL table has {}", bytes.size(), kFile),
                     "copy the file again, whole");
  }
  MerlTable table;
  for (std::size_t i = 0; i < table.stored_.size(); ++i) {
    const auto value = load<double>(bytes.data() + kHeader + i * sizeof(double));
    if (!std::isfinite(value)) {
      throw InputError(file, fmt::format("value {} of {} is not a finite number", i + 1, table.stored_.size()),
                       "copy the file again");
    }
    table.stored_[i] = value;
  }
  return table;
}

MerlTable read_merl(const std::filesystem::path& path) { return decode_merl(path.string(), read_bytes(path)); }

void write_merl(const std::filesystem::path& path, const MerlTable& table) {
  std::string bytes;
  bytes.reserve(kFile);
  for (const std::int32_t bins : {merl_theta_h_bins, merl_theta_d_bins, merl_phi_d_bins}) store(bytes, bins);
  for (const double value : table.stored()) store(bytes, value);
  write_file(path, bytes);
}

MerlTable tabulate(const Brdf& brdf) {
  MerlTable table;
  tbb::parallel_for(0, merl_bins / merl_phi_d_bins, [&](int row) {
    for (int bin = row * merl_phi_d_bins; bin < (row + 1) * merl_phi_d_bins; ++bin) {
      const DirectionPair pair = directions_of(merl_centre(bin));
      if (!(pair.to_light.z() > 0 && pair.to_viewer.z() > 0)) continue;
      table.set(bin, brdf(pair.to_light.cast<float>(), pair.to_viewer.cast<float>()).cast<double>());
    }
  });
  return table;
}

}  // namespace partwise
