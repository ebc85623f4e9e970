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

std::string base64(std::string_view bytes);

// From the doctype to the opening of main.
std::string page_head(std::string_view title);

// Browsers decode pictures when they are about to be seen.
std::string image(const Picture& picture);
std::string figure(const Picture& picture);
std::string figures(const std::vector<Picture>& pictures, std::string_view css_class);

// The first cell of a row names it.
using Row = std::vector<std::string>;
std::string table(const Row& heads, const std::vector<Row>& rows);

// A term and its value, for a list of them.
std::string fact(std::string_view name, std::string_view value, std::string_view unit = "");

// With thin spaces between groups of three digits.
std::string thousands(std::uint64_t number);

}  // namespace demo
