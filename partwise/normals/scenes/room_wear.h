// What the parts of a room are made of: one material, or two in a pattern that goes through the part as the grain goes
// through wood. So a pixel shows one material, and the picture of two is as exact as that of one.
//
//   stripes  across a direction, each as wide as `size`
//   checks   cubes of that side
//   blots    where a smooth random function of space, of that wavelength, is above its middle
//
// Sizes in metres, points in the room's space. Deterministic in the draw. Errors: CheckFailed where there is no
// material, and for settings out of range.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/base/draw.h"

namespace partwise {

enum class Pattern { plain, stripes, checks, blots };

struct PartWear {
  int first = 0, second = 0;  // of the materials
  Pattern pattern = Pattern::plain;
  double size = 0.1;
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  // of stripes, unit length
  std::uint64_t seed = 0;                             // of blots, and of where all begin

  int material(const Eigen::Vector3d& point) const;
};

struct RoomWear {
  std::vector<DsbrdfCoefficients> materials;
  std::vector<PartWear> parts;
};

struct RoomWearSettings {
  int materials = 8;       // that differ in one room, at most
  double patterned = 0.4;  // share of the parts
  double least_size = 0.03, most_size = 0.4;
};

// How much of a depth sensor's light a material keeps from it by throwing it the mirror's way: the share of returns
// that are lost, 0 up to a peak over the half-vector of twice the value 45 degrees beside it, 0.9 from a thousand times
// on, by the logarithm in between; of normal incidence, the largest channel.
double mirror_share(const DsbrdfCoefficients& material);

// For that many parts. `chosen` says which of `materials` are those of the result. Floor, ceiling and walls (room.h)
// wear those that mirror least.
struct DrawnWear : RoomWear {
  std::vector<int> chosen;
};
DrawnWear drawn_wear(int parts, const std::vector<DsbrdfCoefficients>& materials, Draw& draw,
                     const RoomWearSettings& settings = {});

}  // namespace partwise
