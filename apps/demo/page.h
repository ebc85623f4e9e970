// The page that tells the story: one HTML file, pictures, models, style and script inside, nothing fetched from
// anywhere.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "html.h"

namespace demo {

struct Chapter {
  std::string_view id;    // what links to it say
  std::string_view name;  // in the contents
  std::string html;       // a section, without its tags
};

// From shapes over parts to what they are good for (the dissertation's Figure 1.4), a picture each.
struct Station {
  std::string_view chapter, name;
  Picture picture;
};

struct Page {
  Picture hero;
  std::string facts;  // below it
  std::vector<Station> story;
  std::vector<Chapter> chapters;
  std::string credits;
  int threads = 0;
  double seconds = 0;  // of the whole run
};

std::string make_page(const Page& page);

}  // namespace demo
