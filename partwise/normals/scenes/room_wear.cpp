#include "partwise/normals/scenes/room_wear.h"

#include <algorithm>
#include <cmath>

#include "partwise/base/error.h"
#include "partwise/base/splitmix.h"
#include "partwise/normals/scenes/room.h"

namespace partwise {
namespace {

using Lattice = Eigen::Matrix<std::int64_t, 3, 1>;

double unit_at(std::uint64_t seed, const Lattice& corner) {
  std::uint64_t mixed = seed;
  for (const std::int64_t each : corner) mixed = splitmix(mixed + splitmix_step + static_cast<std::uint64_t>(each));
  return static_cast<double>(mixed >> 11) * 0x1p-53;
}

// Random values at the corners of unit cubes, smoothly in between.
double smooth_noise(std::uint64_t seed, const Eigen::Vector3d& place) {
  const Eigen::Vector3d low = place.array().floor();
  const Eigen::Vector3d within = place - low;
  const Eigen::Vector3d weight = within.array().square() * (3 - 2 * within.array());
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Lattice step(corner & 1, corner >> 1 & 1, corner >> 2);
    double share = 1;
    for (int k = 0; k < 3; ++k) share *= step[k] == 1 ? weight[k] : 1 - weight[k];
    sum += share * unit_at(seed, low.cast<std::int64_t>() + step);
  }
  return sum;
}

bool is_odd(double cell) { return std::fmod(std::abs(cell), 2) == 1; }

Eigen::Vector3d drawn_direction(Draw& draw) {
  for (;;) {
    const Eigen::Vector3d v(draw.within(-1, 1), draw.within(-1, 1), draw.within(-1, 1));
    if (v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
  }
}

PartWear drawn_part(Draw& draw, const std::vector<int>& choice, const RoomWearSettings& settings) {
  const auto one = [&] { return choice[static_cast<std::size_t>(draw.below(static_cast<int>(choice.size())))]; };
  PartWear part;
  part.first = one();
  part.second = one();
  if (draw.unit() < settings.patterned) part.pattern = static_cast<Pattern>(1 + draw.below(3));
  part.size = settings.least_size * std::pow(settings.most_size / settings.least_size, draw.unit());
  part.across = drawn_direction(draw);
  part.seed = static_cast<std::uint64_t>(draw.below(1 << 30));
  return part;
}

}  // namespace

int PartWear::material(const Eigen::Vector3d& point) const {
  if (pattern == Pattern::plain) return first;
  // Off the lattice of whole metres, on which walls and floors would lie between two cells.
  const Eigen::Vector3d place = point / size + Eigen::Vector3d::Constant(0.31 + static_cast<double>(seed % 7919));
  bool other = false;
  if (pattern == Pattern::stripes) other = is_odd(std::floor(across.dot(place)));
  if (pattern == Pattern::checks) other = is_odd(place.array().floor().sum());
  if (pattern == Pattern::blots) other = smooth_noise(seed, place) > 0.5;
  return other ? second : first;
}

double mirror_share(const DsbrdfCoefficients& material) {
  constexpr double dull = 2, mirror = 1000, most = 0.9, beside_cosine = 0.70710678118654752;
  const DsbrdfLobes lobes = Dsbrdf(material).lobes(0);
  const double peak = lobes.value(1).maxCoeff(), beside = lobes.value(beside_cosine).maxCoeff();
  const double steps = std::log(peak / std::max(beside, 1e-9) / dull) / std::log(mirror / dull);
  return most * std::clamp(steps, 0.0, 1.0);
}

DrawnWear drawn_wear(int parts, const std::vector<DsbrdfCoefficients>& materials, Draw& draw,
                     const RoomWearSettings& settings) {
  PARTWISE_CHECK(materials.empty(), ==, false);
  PARTWISE_CHECK(settings.materials, >=, 1);
  PARTWISE_CHECK(settings.least_size, >, 0);
  PARTWISE_CHECK(settings.most_size, >=, settings.least_size);
  const int count = std::min(settings.materials, static_cast<int>(materials.size()));
  DrawnWear wear;
  wear.chosen = draw.different(count, static_cast<int>(materials.size()));
  std::vector<int> all, dull;
  std::vector<double> mirrors;
  for (const int each : wear.chosen) {
    all.push_back(static_cast<int>(all.size()));
    wear.materials.push_back(materials[static_cast<std::size_t>(each)]);
    mirrors.push_back(mirror_share(wear.materials.back()));
  }
  dull = all;
  std::ranges::stable_sort(dull, {}, [&](int material) { return mirrors[static_cast<std::size_t>(material)]; });
  dull.resize(static_cast<std::size_t>((count + 1) / 2));
  for (int part = 0; part < parts; ++part)
    wear.parts.push_back(drawn_part(draw, part < first_furniture_part ? dull : all, settings));
  return wear;
}

}  // namespace partwise
