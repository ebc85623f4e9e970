#include "partwise/parts/applications/net_sheets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/orientation.h"
#include "partwise/parts/applications/sheet_drawing.h"

namespace partwise {
namespace {

using Eigen::Vector2d;
using Box = Eigen::AlignedBox2d;

constexpr double gap = 4;           // millimetres between nets
constexpr double flat_fold = 1e-3;  // radians: less is not drawn

template <typename Visit>
void for_points(Net& net, const Visit& visit) {
  for (NetFace& face : net.faces)
    for (Vector2d& p : face.corners) visit(p);
  for (NetEdge& cut : net.cuts)
    for (Vector2d& p : cut.tab) visit(p);
}

Box box_of(Net& net) {
  Box box;
  for_points(net, [&](const Vector2d& p) { box.extend(p); });
  return box;
}

// Upright, in the one of 90 directions in which its box is smallest.
void turn_to_smallest_box(Net& net) {
  double least = std::numeric_limits<double>::infinity();
  Eigen::Rotation2Dd best(0);
  for (int degrees = 0; degrees < 90; ++degrees) {
    const Eigen::Rotation2Dd turn(degrees * std::numbers::pi / 180);
    Box box;
    for_points(net, [&](const Vector2d& p) { box.extend(turn * p); });
    if (box.volume() < least) least = box.volume(), best = turn;
  }
  for_points(net, [&](Vector2d& p) { p = best * p; });
  const Vector2d size = box_of(net).sizes();
  if (size.x() > size.y()) for_points(net, [&](Vector2d& p) { p = Vector2d(-p.y(), p.x()); });
}

double largest_scale(std::vector<PlacedNet>& nets, const Vector2d& room) {
  double scale = std::numeric_limits<double>::infinity();
  for (PlacedNet& placed : nets)
    scale = std::min(scale, (room.array() / box_of(placed.net).sizes().array()).minCoeff());
  return scale;
}

struct Row {
  int page;
  double bottom, height, end;  // where the next net starts
};

// First fit of boxes, highest first: into the first row with room, else a row of its own, else a page.
void set_in_rows(Sheets& sheets, const Vector2d& room) {
  std::vector<std::size_t> order(sheets.nets.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto height = [&](std::size_t n) { return box_of(sheets.nets[n].net).sizes().y(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return height(a) > height(b); });
  std::vector<Row> rows;
  for (const std::size_t n : order) {
    PlacedNet& placed = sheets.nets[n];
    const Box box = box_of(placed.net);
    const Vector2d size = box.sizes();
    constexpr double slack = 1e-9;
    auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
      return r.end + size.x() <= room.x() + slack && size.y() <= r.height + slack;
    });
    if (row == rows.end()) {
      Row fresh{.page = 0, .bottom = room.y() - size.y(), .height = size.y(), .end = 0};
      if (!rows.empty()) {
        fresh.page = rows.back().page;
        fresh.bottom = rows.back().bottom - gap - size.y();
        if (fresh.bottom < -slack) ++fresh.page, fresh.bottom = room.y() - size.y();
      }
      rows.push_back(fresh);
      row = rows.end() - 1;
    }
    const Vector2d by = Vector2d(row->end, row->bottom + row->height - size.y()) +
                        Vector2d::Constant(sheets.settings.margin) - box.min();
    for_points(placed.net, [&](Vector2d& p) { p += by; });
    placed.page = row->page;
    row->end += size.x() + gap;
  }
  sheets.pages = rows.back().page + 1;
  std::stable_sort(sheets.nets.begin(), sheets.nets.end(),
                   [](const PlacedNet& a, const PlacedNet& b) { return a.page < b.page; });
}

// A number inside of the side, small enough for it.
Label number_at(const NetFace& face, const NetEdge& cut) {
  const Vector2d &a = face.corners[static_cast<std::size_t>(cut.side)],
                 &b = face.corners[static_cast<std::size_t>(cut.side + 1) % 3],
                 &c = face.corners[static_cast<std::size_t>(cut.side + 2) % 3];
  const double length = (b - a).norm(), across = std::abs(cross(b - a, c - a)) / length;
  const double size = std::min({2.8, 0.35 * length, 0.4 * across});
  const Vector2d u = (b - a) / length, inward(-u.y(), u.x());
  return {.at = (a + b) / 2 + 0.7 * size * inward, .size = size, .text = std::to_string(cut.number), .colour = 0.25};
}

Drawing drawing_of(const Sheets& sheets, int page) {
  Drawing drawing;
  for (const PlacedNet& placed : sheets.nets) {
    if (placed.page != page) continue;
    const NetFace* largest = nullptr;
    double most = 0;
    for (const NetEdge& cut : placed.net.cuts)
      if (!cut.tab.empty()) drawing.areas.push_back({.corners = cut.tab, .colour = 0.88});
    for (const NetFace& face : placed.net.faces) {
      const double area = cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
      if (area > most) most = area, largest = &face;
      if (face.parent < 0 || std::abs(face.angle) < flat_fold) continue;
      const auto k = static_cast<std::size_t>(face.fold);
      drawing.lines.push_back({.points = {face.corners[k], face.corners[(k + 1) % 3]},
                               .style = face.angle > 0 ? LineStyle::ridge : LineStyle::valley});
    }
    for (const NetEdge& cut : placed.net.cuts) {
      const NetFace& face = placed.net.faces[static_cast<std::size_t>(cut.net_face)];
      const Vector2d &a = face.corners[static_cast<std::size_t>(cut.side)],
                     &b = face.corners[static_cast<std::size_t>(cut.side + 1) % 3];
      if (cut.tab.empty()) {
        drawing.lines.push_back({.points = {a, b}, .style = LineStyle::cut});
      } else {
        drawing.lines.push_back({.points = {cut.tab[1], cut.tab[2], cut.tab[3], cut.tab[0]}, .style = LineStyle::cut});
        drawing.lines.push_back({.points = {a, b}, .style = LineStyle::ridge});
      }
      if (cut.number >= 0) drawing.labels.push_back(number_at(face, cut));
    }
    drawing.labels.push_back({.at = (largest->corners[0] + largest->corners[1] + largest->corners[2]) / 3,
                              .size = std::min(6.0, 0.3 * std::sqrt(most)),
                              .text = std::string("part ") + std::to_string(placed.part),
                              .colour = 0.5});
  }
  return drawing;
}

std::vector<Drawing> drawings_of(const Sheets& sheets) {
  std::vector<Drawing> drawings;
  for (int page = 0; page < sheets.pages; ++page) drawings.push_back(drawing_of(sheets, page));
  return drawings;
}

}  // namespace

Sheets lay_out(std::span<const Unfolding> unfoldings, const PageSettings& settings) {
  Sheets sheets;
  sheets.settings = settings;
  for (std::size_t part = 0; part < unfoldings.size(); ++part)
    for (const Net& net : unfoldings[part].nets) sheets.nets.push_back({.part = static_cast<int>(part), .net = net});
  if (sheets.nets.empty()) throw InputError("nets", "there are none", "give at least one");
  for (PlacedNet& placed : sheets.nets) turn_to_smallest_box(placed.net);
  const Vector2d room(settings.width - 2 * settings.margin, settings.height - 2 * settings.margin);
  const double largest = largest_scale(sheets.nets, room);
  sheets.scale = settings.scale > 0 ? settings.scale : largest;
  if (sheets.scale > largest) {
    throw InputError("scale", fmt::format("at {} mm a unit the largest net does not fit the page", settings.scale),
                     fmt::format("give {:.6g} or less", largest));
  }
  for (PlacedNet& placed : sheets.nets) for_points(placed.net, [&](Vector2d& p) { p *= sheets.scale; });
  set_in_rows(sheets, room);
  return sheets;
}

std::string as_svg(const Sheets& sheets) {
  return svg_of(drawings_of(sheets), sheets.settings.width, sheets.settings.height);
}

std::string as_pdf(const Sheets& sheets) {
  return pdf_of(drawings_of(sheets), sheets.settings.width, sheets.settings.height);
}

}  // namespace partwise
