// Drops a body onto the floor and watches it come to rest.
#pragma once

#include <span>

#include "compound.h"

struct DropSettings {
  double height = 0.5;          // of the lowest point above the floor at the start, metres
  double tilt = 0.4;            // about the horizontal axis (1, 0, 1), radians
  double longest = 15;          // seconds
  double still_speed = 0.01;    // metres a second; at rest means below both for a whole second
  double still_turning = 0.02;  // radians a second
};

struct Drop {
  bool rested = false;
  double seconds = 0;      // simulated, until that second of stillness began; `longest` when it never did
  double lowest = 0;       // height of the lowest point of any hull at the end, metres: 0 touches, below 0 sinks in
  double last_wobble = 0;  // largest turn of the body's up direction within the last second, radians
  btTransform pose = btTransform::getIdentity();
};

Drop drop(const Compound& compound, std::span<const partwise::Mesh> hulls, const DropSettings& settings = {});
