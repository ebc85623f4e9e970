// Colours for parts: calm, and as far apart for the eye as calm colours can be.
//
// Farthest-first traversal (Gonzalez 1985) of the colours of medium lightness and low chroma in the OKLab space
// (Ottosson 2020), from a slate blue on: however many parts there are, the first are the farthest apart, and part 3 has
// the same colour in every picture. After `part_colours` colours they repeat.
#pragma once

#include <Eigen/Core>

namespace partwise {

inline constexpr int part_colours = 48;

// Linear RGB in [0, 1] of part `index`, 0 or more.
Eigen::Vector3f part_colour(int index);

// Linear RGB of a value in [0, 1]: lightness rises evenly from dark blue over teal to yellow, so that values come in
// the same order for every eye and in print. Values outside are taken to the nearer end.
Eigen::Vector3f value_colour(float value);

// Linear RGB of an OKLab colour; components outside [0, 1] mean that no display has it.
Eigen::Vector3f linear_from_oklab(const Eigen::Vector3f& lab);

}  // namespace partwise
