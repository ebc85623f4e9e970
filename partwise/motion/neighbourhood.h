// Which obstacles are neighbours, and over what distances, by their contact samples (margin_field.h says how).
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "partwise/motion/contact_samples.h"

namespace partwise {

using ObstaclePair = std::pair<int, int>;  // the lower number first

ObstaclePair ordered(int a, int b);

struct Neighbourhood {
  std::map<ObstaclePair, double> gaps;
  std::vector<std::vector<int>> neighbours;  // of each obstacle, by number
  std::vector<double> reaches;               // of each obstacle
};

Neighbourhood neighbourhood(const ConfigurationSpace& space, const ContactSamples& samples, std::uint64_t seed);

}  // namespace partwise
