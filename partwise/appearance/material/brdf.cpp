#include "partwise/appearance/material/brdf.h"

#include <Eigen/Geometry>

#include <cmath>

namespace partwise {

HalfAngles half_angles(const Eigen::Vector3d& to_light, const Eigen::Vector3d& to_viewer) {
  const Eigen::Vector3d light = to_light.normalized(), viewer = to_viewer.normalized();
  const Eigen::Vector3d sum = light + viewer;
  const double across = std::hypot(sum.x(), sum.y());
  const double cos_phi = across > 0 ? sum.x() / across : 1, sin_phi = across > 0 ? sum.y() / across : 0;
  const double length = std::hypot(across, sum.z());
  const double sin_theta = length > 0 ? across / length : 0, cos_theta = length > 0 ? sum.z() / length : 1;
  // The light turned by -phi_h about z, then by -theta_h about y.
  const double radial = cos_phi * light.x() + sin_phi * light.y();
  const double x = cos_theta * radial - sin_theta * light.z(), y = cos_phi * light.y() - sin_phi * light.x();
  return {std::atan2(across, sum.z()), std::atan2((light - viewer).norm(), sum.norm()), std::atan2(y, x)};
}

DirectionPair directions_of(const HalfAngles& angles) {
  const double sin_h = std::sin(angles.theta_h), cos_h = std::cos(angles.theta_h);
  const auto turned = [&](double phi_d) {
    const double across = std::sin(angles.theta_d), along = std::cos(angles.theta_d);
    const double x = across * std::cos(phi_d), y = across * std::sin(phi_d);
    return Eigen::Vector3d(cos_h * x + sin_h * along, y, cos_h * along - sin_h * x);
  };
  const Eigen::Vector3d to_light = turned(angles.phi_d);
  const Eigen::Vector3d half(sin_h, 0, cos_h);
  return {to_light, 2 * half.dot(to_light) * half - to_light};
}

}  // namespace partwise
