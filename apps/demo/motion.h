// What the page shows of motion: the medial axis among the houses of a town, a way through it, how long it takes beside
// the methods of others, and a stick that is carried through a window.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "html.h"
#include "turnable.h"

namespace demo {

struct AxisStory {  // of one method
  std::string_view name;
  double seconds = 0, on_axis = 0;  // of the samples, a share
};

struct WayStory {
  std::string_view name;
  double length = 0, clearance = 0;  // metres, the smallest
};

struct MotionStory {
  int houses = 0, samples = 0;
  Picture town;
  Turnable window;
  std::vector<AxisStory> methods;
  std::vector<WayStory> ways;
  double seconds = 0;
};

MotionStory tell_motion();

std::string motion_chapter(const MotionStory& story);
std::string motion_credits();

}  // namespace demo
