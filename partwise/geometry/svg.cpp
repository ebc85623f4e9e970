// The filled shapes of an SVG file: path, polygon and rect, with their transforms. XML by tinyxml2.
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cstring>
#include <string>

#include "partwise/base/error.h"
#include "partwise/geometry/polygon_formats.h"
#include "partwise/geometry/svg_path.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

struct Shape {
  std::vector<std::vector<Curve>> subpaths;
  FillRule rule = FillRule::non_zero;
};

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  void element(const tinyxml2::XMLElement& element, Eigen::Affine2d transform, FillRule rule) {
    const std::string_view whole = element.Name();
    const std::string_view name = whole.substr(whole.find(':') + 1);  // find's npos + 1 is 0
    const std::string place = fmt::format("{}:{}", file_, element.GetLineNum());
    for (const char* unseen : {"defs", "symbol", "clipPath", "mask", "marker", "pattern"}) {
      if (name == unseen) return;
    }
    if (const char* text = element.Attribute("transform")) transform = transform * parse_svg_transform(place, text);
    if (const char* text = element.Attribute("fill-rule")) rule = rule_of(text);
    if (const char* text = element.Attribute("style")) {
      const std::string_view style = text;
      if (style.find("fill-rule:evenodd") != std::string_view::npos) rule = FillRule::even_odd;
    }
    std::vector<std::vector<Curve>> subpaths;
    if (name == "path") {
      if (const char* data = element.Attribute("d")) subpaths = parse_svg_path(place, data);
    } else if (name == "polygon") {
      if (const char* points = element.Attribute("points")) subpaths.push_back(closed(points_of(place, points)));
    } else if (name == "rect") {
      const double x = element.DoubleAttribute("x"), y = element.DoubleAttribute("y");
      const double w = element.DoubleAttribute("width"), h = element.DoubleAttribute("height");
      subpaths.push_back(closed({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}));
    }
    for (auto& subpath : subpaths) {
      for (Curve& curve : subpath) {
        for (Point2& p : curve.control) p = transform * p;
      }
    }
    if (!subpaths.empty()) shapes.push_back({std::move(subpaths), rule});
    for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
      this->element(*child, transform, rule);
    }
  }

  std::vector<Shape> shapes;
  const std::string& file() const { return file_; }

 private:
  static FillRule rule_of(const char* text) {
    return std::strcmp(text, "evenodd") == 0 ? FillRule::even_odd : FillRule::non_zero;
  }

  std::vector<Point2> points_of(const std::string& place, std::string_view text) const {
    const std::vector<double> numbers = parse_svg_numbers(place, text);
    if (numbers.size() % 2 != 0) throw InputError(place, "a polygon has half a point", "correct its points");
    std::vector<Point2> points;
    for (std::size_t i = 0; i < numbers.size(); i += 2) points.emplace_back(numbers[i], numbers[i + 1]);
    return points;
  }

  static std::vector<Curve> closed(const std::vector<Point2>& corners) {
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Point2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
      curves.push_back({{a, a, b, b}, true});
    }
    return curves;
  }

  std::string file_;
};

double longer_side(const std::vector<Shape>& shapes) {
  Eigen::AlignedBox2d box;
  for (const Shape& shape : shapes) {
    for (const auto& subpath : shape.subpaths) {
      for (const Curve& curve : subpath) {
        for (const Point2& p : curve.control) box.extend(p);
      }
    }
  }
  return box.isEmpty() ? 0 : box.sizes().maxCoeff();
}

}  // namespace

Polygons read_svg(const std::string& file, std::string_view bytes, double flattening) {
  tinyxml2::XMLDocument document;
  if (document.Parse(bytes.data(), bytes.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(fmt::format("{}:{}", file, document.ErrorLineNum()),
                     fmt::format("is not well-formed XML ({})", shown_reason(document.ErrorName())), "export it again");
  }
  if (document.RootElement() == nullptr) throw InputError(file, "has no element", "give an SVG file");
  Reader reader(file);
  reader.element(*document.RootElement(), Eigen::Affine2d::Identity(), FillRule::non_zero);
  const double tolerance = flattening > 0 ? flattening : std::max(longer_side(reader.shapes) / 2000, 1e-300);
  Polygons polygons;
  for (const Shape& shape : reader.shapes) {
    std::vector<Ring> rings;
    for (const auto& subpath : shape.subpaths) {
      std::vector<Point2> corners;
      for (const Curve& curve : subpath) flatten(curve, tolerance, corners);
      rings.push_back(ring_of(corners));
      check_finite(rings.back(), reader.file());  // before rings are compared by their areas
    }
    for (Polygon& polygon : assemble_polygons(std::move(rings), shape.rule)) polygons.push_back(std::move(polygon));
  }
  return polygons;
}

}  // namespace partwise
