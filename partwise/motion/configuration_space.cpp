#include "partwise/motion/configuration_space.h"

#include <cmath>
#include <numbers>

#include "partwise/base/error.h"

namespace partwise {
namespace {

using Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;

Quaterniond rotation(const Configuration& q) { return {q[3], q[4], q[5], q[6]}; }

Quaterniond exponential(const Vector3d& rotation_vector) {
  const double angle = rotation_vector.norm();
  const double share = angle < 1e-8 ? 0.5 : std::sin(angle / 2) / angle;
  return {std::cos(angle / 2), share * rotation_vector.x(), share * rotation_vector.y(), share * rotation_vector.z()};
}

// The shortest rotation vector.
Vector3d logarithm(const Quaterniond& q) {
  const Vector3d imaginary = (q.w() < 0 ? -1.0 : 1.0) * q.vec();
  const double sine = imaginary.norm();
  if (sine < 1e-12) return 2 * imaginary;
  return 2 * std::atan2(sine, std::abs(q.w())) / sine * imaginary;
}

}  // namespace

double wrapped_angle(double angle) {
  constexpr double turn = 2 * std::numbers::pi;
  return angle - turn * std::floor(angle / turn + 0.5);
}

Eigen::Vector4d quaternion_coordinates(Quaterniond rotation) {
  rotation.normalize();
  const double sign = rotation.w() < 0 ? -1 : 1;
  return {sign * rotation.w(), sign * rotation.x(), sign * rotation.y(), sign * rotation.z()};
}

ConfigurationSpace::ConfigurationSpace(SpaceKind kind, const Eigen::AlignedBox3d& bounds, double rotation_scale)
    : kind_(kind), bounds_(bounds), scale_(rotation_scale) {
  const auto head = [&](const Vector3d& corner) { return corner.head(positions()).eval(); };
  const bool finite = head(bounds.min()).allFinite() && head(bounds.max()).allFinite();
  if (!finite || (head(bounds.max()).array() <= head(bounds.min()).array()).any())
    throw InputError("bounds", "leave no room", "give a lower and a higher number for each axis");
  if (rotates()) PARTWISE_CHECK(rotation_scale, >, 0);
}

int ConfigurationSpace::degrees_of_freedom() const {
  return positions() + (kind_ == SpaceKind::se2 ? 1 : kind_ == SpaceKind::se3 ? 3 : 0);
}
int ConfigurationSpace::embedding() const {
  return positions() + (kind_ == SpaceKind::se2 ? 2 : kind_ == SpaceKind::se3 ? 9 : 0);
}

MotionVector ConfigurationSpace::embedded(const Configuration& q) const {
  PARTWISE_CHECK(q.size(), ==, coordinates());
  if (!rotates()) return q;
  MotionVector point(embedding());
  point.head(positions()) = q.head(positions());
  if (kind_ == SpaceKind::se2) {
    point.tail<2>() << scale_ * std::cos(q[2]), scale_ * std::sin(q[2]);
  } else {
    const Matrix3d matrix = rotation(q).toRotationMatrix();
    point.tail<9>() = scale_ / std::numbers::sqrt2 * matrix.reshaped();
  }
  return point;
}

Tangent ConfigurationSpace::pulled_back(const Configuration& q, const MotionVector& g) const {
  PARTWISE_CHECK(g.size(), ==, embedding());
  if (!rotates()) return g;
  Tangent gradient(degrees_of_freedom());
  gradient.head(positions()) = g.head(positions());
  if (kind_ == SpaceKind::se2) {
    gradient[2] = std::cos(q[2]) * g[3] - std::sin(q[2]) * g[2];
  } else {
    // d/dw of exp(w) R is the cross product of each column of R with the gradient to it.
    const Matrix3d matrix = rotation(q).toRotationMatrix();
    Vector3d turning = Vector3d::Zero();
    for (int c = 0; c < 3; ++c) turning += matrix.col(c).cross(Vector3d(g.segment<3>(3 + 3 * c)));
    gradient.tail<3>() = turning / std::numbers::sqrt2;
  }
  return gradient;
}

Configuration ConfigurationSpace::moved(const Configuration& q, const Tangent& by) const {
  PARTWISE_CHECK(by.size(), ==, degrees_of_freedom());
  Configuration result = q;
  result.head(positions()) += by.head(positions());
  if (kind_ == SpaceKind::se2) result[2] = wrapped_angle(q[2] + by[2] / scale_);
  if (kind_ == SpaceKind::se3)
    result.tail<4>() = quaternion_coordinates(exponential(by.tail<3>() / scale_) * rotation(q));
  return result;
}

Tangent ConfigurationSpace::difference(const Configuration& a, const Configuration& b) const {
  Tangent result(degrees_of_freedom());
  result.head(positions()) = b.head(positions()) - a.head(positions());
  if (kind_ == SpaceKind::se2) result[2] = scale_ * wrapped_angle(b[2] - a[2]);
  if (kind_ == SpaceKind::se3) result.tail<3>() = scale_ * logarithm(rotation(b) * rotation(a).conjugate());
  return result;
}

Configuration ConfigurationSpace::between(const Configuration& a, const Configuration& b, double share) const {
  return moved(a, share * difference(a, b));
}

double ConfigurationSpace::displacement(const Configuration& a, const Configuration& b) const {
  const Tangent by = difference(a, b);
  const auto turning = degrees_of_freedom() - positions();
  return by.head(positions()).norm() + by.tail(turning).norm();
}

bool ConfigurationSpace::within_bounds(const Configuration& q) const {
  for (int i = 0; i < positions(); ++i) {
    if (q[i] < bounds_.min()[i] || q[i] > bounds_.max()[i]) return false;
  }
  return true;
}

Configuration ConfigurationSpace::drawn(Draw& draw) const {
  Configuration q(coordinates());
  for (int i = 0; i < positions(); ++i) q[i] = draw.within(bounds_.min()[i], bounds_.max()[i]);
  if (kind_ == SpaceKind::se2) q[2] = draw.within(-std::numbers::pi, std::numbers::pi);
  if (kind_ == SpaceKind::se3) {  // evenly over the unit quaternions (Shoemake 1992)
    const double u = draw.unit(), v = 2 * std::numbers::pi * draw.unit(), w = 2 * std::numbers::pi * draw.unit();
    const double a = std::sqrt(1 - u), b = std::sqrt(u);
    q.tail<4>() = quaternion_coordinates({b * std::cos(w), a * std::sin(v), a * std::cos(v), b * std::sin(w)});
  }
  return q;
}

Eigen::Isometry3d ConfigurationSpace::pose(const Configuration& q) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().head(positions()) = q.head(positions());
  if (kind_ == SpaceKind::se2) pose.linear() = Eigen::AngleAxisd(q[2], Vector3d::UnitZ()).toRotationMatrix();
  if (kind_ == SpaceKind::se3) pose.linear() = rotation(q).toRotationMatrix();
  return pose;
}

}  // namespace partwise
