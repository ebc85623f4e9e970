// Nets laid out on pages to print, as SVG and as PDF.
//
// One scale for all nets, so that parts fit together when they are glued: as large as the largest net allows, or as
// asked for. Each net is turned so that its box is smallest; boxes are set in rows, highest first (first fit). Drawn:
// cuts as solid lines, tabs in grey, ridges (fold away from you) dashed, valleys (fold towards you) dash-dotted, flat
// folds not at all. The numbers of sides that are glued together are written inside of them, each net's part in its
// middle. The printed side is the outside of the model.
//
// The SVG has all pages one below the other, lengths in millimetres; the PDF (1.4, uncompressed, Helvetica) one page
// each. Deterministic. Errors: InputError when no net has a face, or one does not fit the page at the scale asked for.
#pragma once

#include <Eigen/Geometry>

#include <span>
#include <string>
#include <vector>

#include "partwise/parts/applications/net.h"

namespace partwise {

struct PageSettings {
  double width = 210, height = 297, margin = 10;  // millimetres; A4
  double scale = 0;                               // millimetres a model unit; 0: as large as fits
};

struct PlacedNet {
  int part = 0;
  Net net;  // in millimetres, where it is on its page: x to the right, y up, from the lower left corner
  int page = 0;
};

struct Sheets {
  PageSettings settings;
  double scale = 0;  // millimetres a model unit
  int pages = 0;
  std::vector<PlacedNet> nets;
};

// unfoldings: one a part.
Sheets lay_out(std::span<const Unfolding> unfoldings, const PageSettings& settings = {});

std::string as_svg(const Sheets& sheets);
std::string as_pdf(const Sheets& sheets);

}  // namespace partwise
