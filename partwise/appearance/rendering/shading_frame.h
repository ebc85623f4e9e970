// Directions as a surface sees them, for materials that are given in the frame of the surface. The view is the constant
// +z of (3.2). Internal to this room.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace partwise {

// A surface that turns away from the viewer is seen at this cosine, so that a material goes on smoothly past the rim of
// what is visible, where normals between the corners of faces lie.
inline constexpr float least_view_cosine = 1e-3f;

struct ShadingFrame {
  Eigen::Vector3f normal, tangent, bitangent;  // the viewer lies in the plane of normal and tangent
  Eigen::Vector3f to_viewer;                   // in this frame

  explicit ShadingFrame(const Eigen::Vector3f& n) : normal(n) {
    const Eigen::Vector3f across(-n.z() * n.x(), -n.z() * n.y(), 1 - n.z() * n.z());  // +z without its part along n
    const float length = across.norm();
    tangent = length > 1e-6f ? Eigen::Vector3f(across / length) : n.unitOrthogonal();
    bitangent = n.cross(tangent);
    const float cosine = std::clamp(n.z(), least_view_cosine, 1.0f);
    to_viewer = {std::sqrt(1 - cosine * cosine), 0, cosine};
  }

  Eigen::Vector3f local(const Eigen::Vector3f& d) const { return {tangent.dot(d), bitangent.dot(d), normal.dot(d)}; }
};

}  // namespace partwise
