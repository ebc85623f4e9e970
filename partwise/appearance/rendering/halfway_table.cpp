#include "partwise/appearance/rendering/halfway_table.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/appearance/rendering/lobe_values.h"

namespace partwise {
namespace {

constexpr double quarter = std::numbers::pi / 2;

std::vector<float> all_knots() {
  std::vector<float> knots;
  knots.reserve(HalfwayTable::places);
  for (int place = 0; place < HalfwayTable::places; ++place) knots.push_back(HalfwayTable::knot(place));
  return knots;
}

}  // namespace

float HalfwayTable::knot(int place) {
  const int near = std::min(place, places - 1 - place);
  const float mantissa = 1 + static_cast<float>(near & ((1 << mantissa_bits) - 1)) / (1 << mantissa_bits);
  const float m = std::min(std::ldexp(mantissa * offset, near >> mantissa_bits) - offset, 0.5f);
  return near == place ? m : 1 - m;
}

HalfwayTable::HalfwayTable(const Dsbrdf& material) : table_(std::make_unique_for_overwrite<Row[]>(rows)) {
  constexpr int together = 8;
  static const std::vector<float> knots = all_knots();
  tbb::parallel_for(0, rows, [&](int i) {
    const DsbrdfLobes lobes = material.lobes(quarter * i / (rows - 1));
    const Eigen::Matrix3f kappa = lobes.kappa.cast<float>(), gamma = lobes.gamma.cast<float>();
    Row& row = table_[static_cast<std::size_t>(i)];
    for (int first = 0; first <= places; first += together) {
      float8::Float8 s{};
      for (int k = 0; k < together; ++k) s[k] = knots[static_cast<std::size_t>(std::min(first + k, places - 1))];
      const LogCosines cosines(s);
      std::array<float8::Float8, 4> values{};  // the fourth stays zero
      for (int channel = 0; channel < 3; ++channel) {
        values[static_cast<std::size_t>(channel)] = lobe_sum(
            cosines, [&](int lobe) { return kappa(channel, lobe); }, [&](int lobe) { return gamma(channel, lobe); });
      }
      float* at = row.data() + 4 * first;
      for (int k = 0; k < std::min(together, places + 1 - first); ++k) {
        for (const float8::Float8& value : values) *at++ = value[k];
      }
    }
  });
}

void HalfwayTable::row(double theta_d, const Eigen::Vector3f& factor, Row& result) const {
  const double at = std::clamp(theta_d / quarter, 0.0, 1.0) * (rows - 1);
  const int below = std::min(static_cast<int>(at), rows - 2);
  const auto part = static_cast<float>(at - below);
  const Row& low = table_[static_cast<std::size_t>(below)];
  const Row& high = table_[static_cast<std::size_t>(below) + 1];
  const float8::Float8 scale{factor[0], factor[1], factor[2], 0, factor[0], factor[1], factor[2], 0};
  for (std::size_t i = 0; i < low.size(); i += 8) {
    const float8::Float8 a = float8::load(low.data() + i), b = float8::load(high.data() + i);
    float8::store(result.data() + i, scale * (a + part * (b - a)));
  }
}

Eigen::Vector3f HalfwayTable::value(float cos_theta_d, float s) const {
  const float across = std::acos(std::clamp(cos_theta_d, 0.0f, 1.0f)) * static_cast<float>((rows - 1) / quarter);
  const int row = std::min(static_cast<int>(across), rows - 2);
  const float down = place(s);
  const int whole = std::min(static_cast<int>(down), places - 2);
  const float a = across - static_cast<float>(row), b = down - static_cast<float>(whole);
  const auto along = [&](int at) -> Eigen::Array4f {
    const Eigen::Map<const Eigen::Array4f> low(table_[static_cast<std::size_t>(at)].data() + 4 * whole);
    const Eigen::Map<const Eigen::Array4f> high(table_[static_cast<std::size_t>(at)].data() + 4 * whole + 4);
    return low + b * (high - low);
  };
  const Eigen::Array4f below = along(row), above = along(row + 1);
  return (below + a * (above - below)).head<3>();
}

}  // namespace partwise
