// What the page shows of a heap of decomposed models: the fall, the heap at rest, and its hulls.
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "pile.h"

namespace demo {

struct HeapStory {
  int bodies = 0, hulls = 0;
  double simulated = 0, seconds = 0, deepest = 0;
  std::vector<Picture> falling;
  Picture heap, heap_hulls;
};

HeapStory tell_heap(const PileSettings& settings, const Pile& pile);

std::string heap_chapter(const HeapStory& story);

}  // namespace demo
