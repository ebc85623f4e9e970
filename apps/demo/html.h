// Pieces of HTML that the sections of the page share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "partwise/imaging/image.h"

namespace demo {

struct Picture {
  std::string data;  // a data: address
  std::string caption, description;
  int width = 0, height = 0;  // pixels
};

Picture make_picture(const partwise::Image& image, std::string caption, std::string description);

// Of an SVG drawing, which must say its width and height.
Picture make_drawing(const std::string& svg, std::string caption, std::string description);

// From the doctype to the opening of main.
std::string page_head(std::string_view title);

std::string figure(const Picture& picture, std::string_view loading);
std::string figures(const std::vector<Picture>& pictures, std::string_view css_class);

// A term and its value, for a list of them.
std::string fact(std::string_view name, std::string_view value, std::string_view unit = "");

// With thin spaces between groups of three digits.
std::string thousands(std::uint64_t number);

}  // namespace demo
