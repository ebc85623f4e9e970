// What the page shows of materials: balls in all that ship, a chair whose parts wear different ones, what is known of
// each pixel of an image, and random images as networks are trained on.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "html.h"
#include "views.h"

namespace demo {

struct MaterialsStory {
  std::vector<Picture> balls, chairs, channels, lights, samples;
  double ball_seconds = 0;  // one ball, mean
  double seconds = 0;       // all of them
};

// `models`: to draw random images of, with the parts that they were decomposed into; `chair` is one of them, which is
// segmented anew.
MaterialsStory tell_materials(std::span<const WornModel> models, const WornModel& chair, const WornModel& car);

std::string materials_chapter(const MaterialsStory& story);
std::string material_credits();

}  // namespace demo
