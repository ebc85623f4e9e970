// The section of the page about features of surfaces.
#pragma once

#include <string>

#include "page.h"

namespace demo {

std::string surfaces_section(const SurfacesStory& surfaces);

}  // namespace demo
