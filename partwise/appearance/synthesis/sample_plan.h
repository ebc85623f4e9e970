// What each image of a data set shows, drawn by chance: the same for a seed and a number, whoever asks and when.
//
// Images come in combinations: a shape, a material for each of its parts (different ones as far as there are enough), a
// light and its turn about y. Of each combination `views` images are made, from as many different ones of
// `viewpoints` fixed places around the object (Liu 2017, section 3.4.1: 5 of 24, at a fixed elevation). With one view
// a combination every image has fresh light and materials.
//
// Random numbers are functions of (seed, combination, what for), so that image i does not depend on those before it:
// ranks share the work by numbers, and work that was stopped goes on where it was.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace partwise {

struct SamplePlan {
  std::uint64_t seed = 0;
  int shapes = 1, materials = 1, lights = 1;  // how many there are to draw from
  std::function<int(int shape)> parts;        // how many a shape has; asked for the shapes that are drawn alone
  int viewpoints = 24;                        // azimuths, evenly spaced
  int views = 5;                              // of each combination, at most viewpoints
};

struct Sample {
  int shape = 0, light = 0, viewpoint = 0;
  std::vector<int> materials;  // of each part of the shape
  double light_turn = 0;       // radians in [0, 2 pi)
};

Sample sample(const SamplePlan& plan, std::uint64_t number);

}  // namespace partwise
