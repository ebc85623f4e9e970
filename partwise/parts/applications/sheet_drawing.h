// Pages of lines, areas and numbers as SVG and as PDF; see net_sheets.h. Lengths in millimetres, y up, from the lower
// left corner of the page; greys from 0, black, to 1.
#pragma once

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace partwise {

enum class LineStyle { cut, ridge, valley };

struct Line {
  std::vector<Eigen::Vector2d> points;
  LineStyle style = LineStyle::cut;
};

struct Area {
  std::vector<Eigen::Vector2d> corners;
  double colour = 0;
};

struct Label {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  // its middle
  double size = 3;
  std::string text;  // letters, digits and spaces
  double colour = 0;
};

struct Drawing {
  std::vector<Area> areas;  // below the lines
  std::vector<Line> lines;
  std::vector<Label> labels;
};

std::string svg_of(std::span<const Drawing> pages, double width, double height);
std::string pdf_of(std::span<const Drawing> pages, double width, double height);

}  // namespace partwise
