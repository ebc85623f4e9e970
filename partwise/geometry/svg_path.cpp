#include "partwise/geometry/svg_path.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "partwise/base/error.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

constexpr double pi = std::numbers::pi;

class Scanner {
 public:
  Scanner(std::string place, std::string_view text) : place_(std::move(place)), text_(text) {}

  void skip() {
    while (at_ < text_.size() && (std::string_view(" \t\r\n\f,").find(text_[at_]) != std::string_view::npos)) ++at_;
  }
  bool done() {
    skip();
    return at_ >= text_.size();
  }
  char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  char take() { return peek() == '\0' ? '\0' : text_[at_++]; }
  bool at_number() {
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
  }
  double number() {
    skip();
    if (at_ < text_.size() && text_[at_] == '+') ++at_;
    double value = 0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc() || !std::isfinite(value)) fail("a number is missing or malformed");
    at_ += static_cast<std::size_t>(end - begin);
    return value;
  }
  bool flag() {  // of an arc: one digit, which may touch the next number
    const char c = take();
    if (c != '0' && c != '1') fail("a flag of an arc is neither 0 nor 1");
    return c == '1';
  }
  Point2 point() {
    const double x = number();
    return {x, number()};
  }
  std::string_view word() {
    skip();
    const std::size_t start = at_;
    while (at_ < text_.size() && std::isalpha(static_cast<unsigned char>(text_[at_]))) ++at_;
    return text_.substr(start, at_ - start);
  }
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(place_, fmt::format("{} at byte {}, before {}", problem, at_, shown(text_.substr(at_, 20))),
                     "correct or export it again");
  }

 private:
  std::string place_;
  std::string_view text_;
  std::size_t at_ = 0;
};

Curve line(const Point2& a, const Point2& b) { return {{a, a, b, b}, true}; }

// The elliptical arc from its end points (SVG 1.1, appendix F.6.5), in pieces.
void append_arc(std::vector<Curve>& curves, const Point2& from, const Point2& to, Point2 radii, double degrees,
                bool large, bool sweep) {
  radii = radii.cwiseAbs();
  if (from == to) return;
  if (radii.x() == 0 || radii.y() == 0) {
    curves.push_back(line(from, to));
    return;
  }
  const Eigen::Rotation2Dd turn(degrees * pi / 180);
  const Point2 half = turn.inverse() * ((from - to) / 2);
  const double stretch = half.cwiseQuotient(radii).squaredNorm();
  if (stretch > 1) radii *= std::sqrt(stretch);
  const Point2 unit = half.cwiseQuotient(radii);
  const double root = std::sqrt(std::max(0.0, 1 / unit.squaredNorm() - 1)) * (large == sweep ? -1 : 1);
  const Point2 unit_centre = root * Point2(unit.y(), -unit.x());
  const Point2 centre = turn * unit_centre.cwiseProduct(radii) + (from + to) / 2;
  const Point2 start = unit - unit_centre, end = -unit - unit_centre;
  const double first = std::atan2(start.y(), start.x());
  double swept = std::atan2(end.y(), end.x()) - first;
  if (sweep && swept < 0) swept += 2 * pi;
  if (!sweep && swept > 0) swept -= 2 * pi;
  // Where coordinates overflow the angle is no number, and what comes of it is refused as not finite.
  const int pieces = std::isfinite(swept) ? std::max(1, static_cast<int>(std::ceil(std::abs(swept) / (pi / 4)))) : 1;
  const double step = swept / pieces, handle = 4.0 / 3.0 * std::tan(step / 4);
  const auto place = [&](const Point2& on_unit) -> Point2 { return centre + turn * on_unit.cwiseProduct(radii); };
  Point2 last = from;
  for (int i = 0; i < pieces; ++i) {
    const double a = first + i * step, b = a + step;
    const Point2 ua(std::cos(a), std::sin(a)), ub(std::cos(b), std::sin(b));
    const Point2 next = i + 1 == pieces ? to : place(ub);
    curves.push_back(
        {{last, place(ua + handle * Point2(-ua.y(), ua.x())), place(ub - handle * Point2(-ub.y(), ub.x())), next}});
    last = next;
  }
}

class PathParser {
 public:
  PathParser(const std::string& place, std::string_view data) : scanner_(place, data) {}

  std::vector<std::vector<Curve>> parse() {
    char command = '\0';
    while (!scanner_.done()) {
      if (!scanner_.at_number()) {
        command = scanner_.take();
      } else if (command == '\0' || command == 'Z' || command == 'z') {
        scanner_.fail("a number comes where a command should be");
      }
      if (subpaths_.empty() && command != 'M' && command != 'm') scanner_.fail("the path does not begin with M");
      step(command);
      if (command == 'M') command = 'L';
      if (command == 'm') command = 'l';
    }
    for (auto& subpath : subpaths_) {
      if (!subpath.empty() && subpath.back().control[3] != subpath.front().control[0]) {
        subpath.push_back(line(subpath.back().control[3], subpath.front().control[0]));
      }
    }
    std::erase_if(subpaths_, [](const auto& subpath) { return subpath.empty(); });
    return std::move(subpaths_);
  }

 private:
  Point2 point(bool relative) { return scanner_.point() + (relative ? current_ : Point2(0, 0)); }

  void add(const Curve& curve) {
    subpaths_.back().push_back(curve);
    current_ = curve.control[3];
  }

  void quadratic(const Point2& control, const Point2& to) {
    add({{current_, current_ + 2.0 / 3.0 * (control - current_), to + 2.0 / 3.0 * (control - to), to}});
    quadratic_handle_ = control;
  }

  void step(char command) {
    const bool relative = command >= 'a';
    const Point2 origin = relative ? current_ : Point2(0, 0);
    const char kind = relative ? static_cast<char>(command - 'a' + 'A') : command;
    const Point2 cubic_handle = last_ == 'C' ? cubic_handle_ : current_;
    const Point2 quadratic_handle = last_ == 'Q' ? quadratic_handle_ : current_;
    last_ = kind == 'S' ? 'C' : kind == 'T' ? 'Q' : kind;
    switch (kind) {
      case 'M':
        current_ = start_ = point(relative);
        subpaths_.emplace_back();
        break;
      case 'L':
        add(line(current_, point(relative)));
        break;
      case 'H':
        add(line(current_, {origin.x() + scanner_.number(), current_.y()}));
        break;
      case 'V':
        add(line(current_, {current_.x(), origin.y() + scanner_.number()}));
        break;
      case 'C':
      case 'S': {
        const Point2 first = kind == 'C' ? point(relative) : Point2(2 * current_ - cubic_handle);
        cubic_handle_ = point(relative);
        const Point2 to = point(relative);
        add({{current_, first, cubic_handle_, to}});
        break;
      }
      case 'Q': {
        const Point2 control = point(relative);
        quadratic(control, point(relative));
        break;
      }
      case 'T':
        quadratic(2 * current_ - quadratic_handle, point(relative));
        break;
      case 'A': {
        const Point2 radii = scanner_.point();
        const double degrees = scanner_.number();
        const bool large = scanner_.flag(), sweep = scanner_.flag();
        const Point2 to = point(relative);
        append_arc(subpaths_.back(), current_, to, radii, degrees, large, sweep);
        current_ = to;
        break;
      }
      case 'Z':
        if (current_ != start_) add(line(current_, start_));
        current_ = start_;
        subpaths_.emplace_back();  // Whatever follows begins at the same point.
        break;
      default:
        scanner_.fail(fmt::format("{} is no command of a path", shown(std::string(1, command))));
    }
  }

  Scanner scanner_;
  std::vector<std::vector<Curve>> subpaths_;
  Point2 current_ = Point2::Zero(), start_ = Point2::Zero(), cubic_handle_ = Point2::Zero(),
         quadratic_handle_ = Point2::Zero();
  char last_ = '\0';
};

}  // namespace

std::vector<std::vector<Curve>> parse_svg_path(const std::string& place, std::string_view data) {
  return PathParser(place, data).parse();
}

std::vector<double> parse_svg_numbers(const std::string& place, std::string_view text) {
  Scanner scanner(place, text);
  std::vector<double> numbers;
  while (!scanner.done()) numbers.push_back(scanner.number());
  return numbers;
}

Eigen::Affine2d parse_svg_transform(const std::string& place, std::string_view text) {
  Scanner scanner(place, text);
  Eigen::Affine2d all = Eigen::Affine2d::Identity();
  while (!scanner.done()) {
    const std::string_view name = scanner.word();
    if (scanner.take() != '(') scanner.fail("a bracket is missing in a transform");
    std::vector<double> n;
    while (scanner.at_number()) n.push_back(scanner.number());
    if (scanner.take() != ')') scanner.fail("a bracket is missing in a transform");
    Eigen::Affine2d one = Eigen::Affine2d::Identity();
    if (name == "translate" && (n.size() == 1 || n.size() == 2)) {
      one.translate(Point2(n[0], n.size() > 1 ? n[1] : 0));
    } else if (name == "scale" && (n.size() == 1 || n.size() == 2)) {
      one.scale(Point2(n[0], n.size() > 1 ? n[1] : n[0]));
    } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
      const Point2 about = n.size() == 3 ? Point2(n[1], n[2]) : Point2(0, 0);
      one.translate(about).rotate(n[0] * pi / 180).translate(-about);
    } else if (name == "skewX" && n.size() == 1) {
      one.matrix()(0, 1) = std::tan(n[0] * pi / 180);
    } else if (name == "skewY" && n.size() == 1) {
      one.matrix()(1, 0) = std::tan(n[0] * pi / 180);
    } else if (name == "matrix" && n.size() == 6) {
      one.matrix().topRows<2>() << n[0], n[2], n[4], n[1], n[3], n[5];
    } else {
      scanner.fail("a transform is unknown or has the wrong number of arguments");
    }
    all = all * one;
  }
  return all;
}

void flatten(const Curve& curve, double tolerance, std::vector<Point2>& corners) {
  const auto& [a, b, c, d] = curve.control;
  // n equal pieces leave their chords by at most 3/4 M / n^2, with M the larger second difference of the control
  // points (Wang 1984).
  const double bend = std::max((a - 2 * b + c).norm(), (b - 2 * c + d).norm());
  const double wanted = std::ceil(std::sqrt(0.75 * bend / tolerance));
  const int pieces = curve.straight || !std::isfinite(wanted) ? 1 : static_cast<int>(std::clamp(wanted, 1.0, 4096.0));
  for (int i = 0; i < pieces; ++i) {
    const double t = static_cast<double>(i) / pieces, s = 1 - t;
    corners.push_back(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
  }
}

}  // namespace partwise
