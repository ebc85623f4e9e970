// .poly as acd2d has it (J.-M. Lien): the number of chains; for each its number of points and "out" or "in", the
// points, and the order in which they are joined, counted from 1.
#include <fmt/format.h>

#include <charconv>
#include <string>

#include "partwise/geometry/polygon_formats.h"
#include "partwise/geometry/text_scanner.h"

namespace partwise {
namespace {

// Coordinates, of which two may have been written without a blank between them: "-6.64248.788605".
class Coordinates {
 public:
  Coordinates(TextScanner& scanner, bool lenient) : scanner_(scanner), lenient_(lenient) {}

  double next(std::string_view what) {
    if (!lenient_) return scanner_.coordinate(what);
    if (rest_.empty()) rest_ = scanner_.token();
    double value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) {
      scanner_.fail(fmt::format("{} is not a number where {} should be", shown(rest_), what), "correct the line");
    }
    rest_ = rest_.substr(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }

 private:
  TextScanner& scanner_;
  bool lenient_;
  std::string_view rest_;  // what is left of a token
};

std::size_t count(TextScanner& scanner, std::string_view what, std::size_t bytes_each) {
  const std::int64_t number = scanner.integer(what);
  if (number < 0 || static_cast<std::size_t>(number) > scanner.remaining() / bytes_each + 1) {
    scanner.fail(fmt::format("{} is {}, which the file is too short for", what, number), "correct the number");
  }
  return static_cast<std::size_t>(number);
}

}  // namespace

Polygons read_poly(const std::string& file, std::string_view bytes, bool lenient) {
  TextScanner scanner(file, bytes, '#');
  const std::size_t chains = count(scanner, "the number of chains", 8);
  Polygons polygons;
  for (std::size_t chain = 0; chain < chains; ++chain) {
    const std::size_t points = count(scanner, "the number of points of a chain", 4);
    const std::string_view kind = scanner.token();
    if (kind != "in" && kind != "out") {
      scanner.fail(fmt::format("{} where \"in\" or \"out\" should be", shown(kind)), "mark the chain");
    }
    Ring given(static_cast<Eigen::Index>(points), 2), ring(static_cast<Eigen::Index>(points), 2);
    Coordinates coordinates(scanner, lenient);
    for (Eigen::Index i = 0; i < given.rows(); ++i) {
      given(i, 0) = coordinates.next("x of a point");
      given(i, 1) = coordinates.next("y of a point");
    }
    for (Eigen::Index i = 0; i < ring.rows(); ++i) {
      const std::int64_t at = scanner.integer("the order of the points");
      if (at < 1 || at > given.rows()) {
        scanner.fail(fmt::format("point {} is named, the chain has {} (from 1)", at, given.rows()),
                     "correct the order");
      }
      ring.row(i) = given.row(at - 1);
    }
    if (kind == "out") {
      polygons.push_back({std::move(ring), {}});
    } else if (polygons.empty()) {
      scanner.fail("a hole comes before any outer chain", "put the outer chain first");
    } else {
      polygons.back().holes.push_back(std::move(ring));
    }
  }
  return polygons;
}

}  // namespace partwise
