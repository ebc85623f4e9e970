// What the page shows of edits: pictures of models, the same in other materials as partwise edit makes them, what the
// networks read off a picture beside the truth, materials swapped between pictures, and parts edited one by one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "html.h"
#include "partwise/imaging/image_metrics.h"
#include "views.h"

namespace demo {

struct EditsStory {
  std::vector<Picture> edits, truths, layers, swaps, parts;
  std::vector<partwise::ImageDifference> differences;  // of edits and truths
  partwise::Image strip;                               // a picture and edits of it
  double error = 0, refined_error = 0;                 // of the picture rendered anew, 0 to 255 squared
  double look_seconds = 0, refine_seconds = 0;         // of one picture
  double seconds = 0;                                  // all of them
};

// The networks that ship read pictures of `car`, of `chair`, whose parts are edited, and of the swapped.
EditsStory tell_edits(const WornModel& car, const WornModel& chair, std::span<const WornModel> swapped);

std::string edits_chapter(const EditsStory& story);

}  // namespace demo
