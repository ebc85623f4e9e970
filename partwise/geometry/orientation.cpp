#include "partwise/geometry/orientation.h"

#include <array>
#include <cmath>
#include <limits>

namespace partwise {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;  // largest relative rounding error
constexpr double orientation_error = (3 + 16 * unit) * unit;
constexpr double circle_error = (10 + 96 * unit) * unit;

// A sum of doubles kept without rounding: parts that do not overlap, the last one non-zero decides the sign.
class Expansion {
 public:
  void add_product(double x, double y) {
    const double high = x * y;
    add(std::fma(x, y, -high));
    add(high);
  }
  int sign() const {
    for (int i = size_; i-- > 0;) {
      if (parts_[i] != 0) return parts_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  void add(double x) {
    for (int i = 0; i < size_; ++i) {
      const double sum = parts_[i] + x;
      const double virtual_x = sum - parts_[i];
      parts_[i] = (parts_[i] - (sum - virtual_x)) + (x - virtual_x);
      x = sum;
    }
    parts_[size_++] = x;
  }

  std::array<double, 12> parts_;
  int size_ = 0;
};

}  // namespace

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (a.x() - c.x()) * (b.y() - c.y()), right = (a.y() - c.y()) * (b.x() - c.x());
  const double area = left - right, error = orientation_error * (std::abs(left) + std::abs(right));
  if (area > error) return 1;
  if (area < -error) return -1;
  Expansion exact;
  const Point2 ac = a - c, bc = b - c;
  if (ac + c == a && bc + c == b && a - ac == c && b - bc == c) {  // differences without rounding, as on pixel grids
    exact.add_product(ac.x(), bc.y());
    exact.add_product(-ac.y(), bc.x());
    return exact.sign();
  }
  exact.add_product(a.x(), b.y());
  exact.add_product(-a.x(), c.y());
  exact.add_product(-c.x(), b.y());
  exact.add_product(-a.y(), b.x());
  exact.add_product(a.y(), c.x());
  exact.add_product(c.y(), b.x());
  return exact.sign();
}

bool inside_circle(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  const Point2 ad = a - d, bd = b - d, cd = c - d;
  const double bc = bd.x() * cd.y(), cb = cd.x() * bd.y(), ca = cd.x() * ad.y(), ac = ad.x() * cd.y();
  const double ab = ad.x() * bd.y(), ba = bd.x() * ad.y();
  const double a2 = ad.squaredNorm(), b2 = bd.squaredNorm(), c2 = cd.squaredNorm();
  const double determinant = a2 * (bc - cb) + b2 * (ca - ac) + c2 * (ab - ba);
  const double permanent =
      a2 * (std::abs(bc) + std::abs(cb)) + b2 * (std::abs(ca) + std::abs(ac)) + c2 * (std::abs(ab) + std::abs(ba));
  return determinant > circle_error * permanent;
}

}  // namespace partwise
