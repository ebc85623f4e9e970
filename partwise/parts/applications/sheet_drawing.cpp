#include "partwise/parts/applications/sheet_drawing.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace partwise {
namespace {

using Eigen::Vector2d;

constexpr double points = 72 / 25.4;  // a millimetre
constexpr double line_width = 0.2, fold_width = 0.15;

const char* dashes(LineStyle style) {
  return style == LineStyle::ridge ? "1.5 1" : style == LineStyle::valley ? "3 0.8 0.4 0.8" : "";
}

// The mean width of Helvetica's letters and digits is a little over half its size.
double text_width(const Label& label) { return 0.53 * label.size * static_cast<double>(label.text.size()); }

void add_svg_page(std::string& svg, const Drawing& page, double top, double width, double height) {
  const auto out = std::back_inserter(svg);
  const auto at = [&](const Vector2d& p) { return fmt::format("{:.4f},{:.4f}", p.x(), top + height - p.y()); };
  fmt::format_to(out, "<rect x=\"0\" y=\"{:.4f}\" width=\"{}\" height=\"{}\" fill=\"white\"/>\n", top, width, height);
  for (const Area& area : page.areas) {
    svg += "<polygon points=\"";
    for (const Vector2d& p : area.corners) svg += at(p) + " ";
    fmt::format_to(out, "\" fill=\"rgb({0},{0},{0})\"/>\n", std::lround(255 * area.colour));
  }
  for (const Line& line : page.lines) {
    svg += "<polyline points=\"";
    for (const Vector2d& p : line.points) svg += at(p) + " ";
    fmt::format_to(out, "\" class=\"{}\"/>\n",
                   line.style == LineStyle::cut     ? "cut"
                   : line.style == LineStyle::ridge ? "ridge"
                                                    : "valley");
  }
  for (const Label& label : page.labels) {
    fmt::format_to(out, "<text x=\"{0:.4f}\" y=\"{1:.4f}\" font-size=\"{2:.3f}\" fill=\"rgb({3},{3},{3})\">{4}</text>\n",
                   label.at.x(), top + height - label.at.y() + 0.35 * label.size, label.size,
                   std::lround(255 * label.colour), label.text);
  }
}

std::string pdf_page(const Drawing& page) {
  std::string content;
  const auto out = std::back_inserter(content);
  const auto path = [&](const std::vector<Vector2d>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i)
      fmt::format_to(out, "{:.3f} {:.3f} {} ", points * corners[i].x(), points * corners[i].y(), i == 0 ? 'm' : 'l');
  };
  for (const Area& area : page.areas) {
    fmt::format_to(out, "{:.3f} g ", area.colour);
    path(area.corners);
    content += "f\n";
  }
  for (const Line& line : page.lines) {
    std::string scaled;
    for (double length : line.style == LineStyle::ridge    ? std::vector<double>{1.5, 1}
                         : line.style == LineStyle::valley ? std::vector<double>{3, 0.8, 0.4, 0.8}
                                                           : std::vector<double>{}) {
      scaled += fmt::format("{:.2f} ", points * length);
    }
    fmt::format_to(out, "0 G {:.3f} w [{}] 0 d ", points * (line.style == LineStyle::cut ? line_width : fold_width),
                   scaled);
    path(line.points);
    content += "S\n";
  }
  for (const Label& label : page.labels) {
    fmt::format_to(out, "BT {:.3f} g /F1 {:.3f} Tf {:.3f} {:.3f} Td ({}) Tj ET\n", label.colour, points * label.size,
                   points * (label.at.x() - text_width(label) / 2), points * (label.at.y() - 0.35 * label.size),
                   label.text);
  }
  return content;
}

}  // namespace

std::string svg_of(std::span<const Drawing> pages, double width, double height) {
  const double all = height * static_cast<double>(pages.size());
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}mm\" height=\"{1}mm\" viewBox=\"0 0 {0} {1}\">\n"
      "<style>polyline {{ fill: none; stroke: black; stroke-width: {2} }} .ridge, .valley {{ stroke-width: {3} }} "
      ".ridge {{ stroke-dasharray: {4} }} .valley {{ stroke-dasharray: {5} }} text {{ font-family: Helvetica, Arial, "
      "sans-serif; text-anchor: middle }}</style>\n",
      width, all, line_width, fold_width, dashes(LineStyle::ridge), dashes(LineStyle::valley));
  for (std::size_t n = 0; n < pages.size(); ++n)
    add_svg_page(svg, pages[n], height * static_cast<double>(n), width, height);
  return svg + "</svg>\n";
}

// Objects: 1 the catalogue, 2 the list of pages, 3 the font, then a page and its content each.
std::string pdf_of(std::span<const Drawing> pages, double width, double height) {
  std::string pdf = "%PDF-1.4\n", kids;
  std::vector<std::size_t> offsets;
  const auto object = [&](const std::string& body) {
    offsets.push_back(pdf.size());
    pdf += fmt::format("{} 0 obj\n{}\nendobj\n", offsets.size(), body);
  };
  for (std::size_t n = 0; n < pages.size(); ++n) kids += fmt::format("{} 0 R ", 4 + 2 * n);
  object("<< /Type /Catalog /Pages 2 0 R >>");
  object(fmt::format("<< /Type /Pages /Kids [{}] /Count {} >>", kids, pages.size()));
  object("<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>");
  for (std::size_t n = 0; n < pages.size(); ++n) {
    object(
        fmt::format("<< /Type /Page /Parent 2 0 R /MediaBox [0 0 {:.3f} {:.3f}] /Resources << /Font << /F1 3 0 R >> "
                    ">> /Contents {} 0 R >>",
                    points * width, points * height, 5 + 2 * n));
    const std::string content = pdf_page(pages[n]);
    object(fmt::format("<< /Length {} >>\nstream\n{}endstream", content.size(), content));
  }
  const std::size_t table = pdf.size();
  pdf += fmt::format("xref\n0 {}\n0000000000 65535 f \n", offsets.size() + 1);
  for (const std::size_t offset : offsets) pdf += fmt::format("{:010} 00000 n \n", offset);
  pdf += fmt::format("trailer\n<< /Size {} /Root 1 0 R >>\nstartxref\n{}\n%%EOF\n", offsets.size() + 1, table);
  return pdf;
}

}  // namespace partwise
