// Shorter paths that keep their clearance: between points drawn at random on the path, straight motions replace what
// lies between (Geraerts, Overmars 2007, who also name what plain shortcuts cost in clearance). A shortcut is taken
// where it keeps `keep` times the smallest clearance of the path as it was given, for certain (free_motion.h); all else
// about the path is free to change.
//
// Ends stay as they are. The same path for the same seed. Errors: Cancelled.
#pragma once

#include <cstdint>

#include "partwise/base/progress.h"
#include "partwise/motion/motion_path.h"

namespace partwise {

struct PathSimplifySettings {
  double keep = 0.9;         // share of the smallest clearance; 0: free is enough
  int most_shortcuts = 400;  // tried
  int most_failures = 60;    // in a row
  double resolution = 1e-5;  // share of the bounds' diagonal, of free_motion.h
  std::uint64_t seed = 0;
};

MotionPath simplified(const Scene& scene, const MotionPath& path, const PathSimplifySettings& settings = {},
                      const Progress& progress = {});

}  // namespace partwise
