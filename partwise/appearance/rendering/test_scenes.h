// Meshes and materials that several tests of this room share. Tests only; not installed.
#pragma once

#include <cmath>
#include <numbers>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/material/microfacet_brdf.h"
#include "partwise/geometry/mesh.h"

namespace partwise::test {

// A sphere of radius 1 about the origin, `rows` bands from pole to pole.
inline Mesh sphere(int rows) {
  const int columns = 2 * rows;
  Mesh mesh;
  mesh.vertices.resize((rows + 1) * columns, 3);
  mesh.faces.resize(2 * rows * columns, 3);
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double t = std::numbers::pi * i / rows, p = 2 * std::numbers::pi * j / columns;
      mesh.vertices.row(i * columns + j) = Point(std::sin(t) * std::sin(p), std::cos(t), std::sin(t) * std::cos(p));
    }
  }
  int face = 0;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const int a = i * columns + j, b = i * columns + (j + 1) % columns, c = a + columns, d = b + columns;
      mesh.faces.row(face++) << a, c, d;
      mesh.faces.row(face++) << a, d, b;
    }
  }
  return mesh;
}

// The rectangle x, y in [-half, half] at height z, facing +z.
inline Mesh square(double half, double z) {
  Mesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << -half, -half, z, half, -half, z, half, half, z, -half, half, z;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 3;
  return mesh;
}

inline MicrofacetBrdf lambert(double albedo) { return MicrofacetBrdf(Eigen::Vector3d::Constant(albedo)); }

// The same lobes in all channels but for their strength; the sharpest has this gamma and rises towards grazing light.
inline Dsbrdf glossy(double kappa, double gamma, double first_gamma = 0.3) {
  DsbrdfCoefficients c;
  for (int channel = 0; channel < 3; ++channel) {
    const int from = channel * dsbrdf_channel_size;
    const auto curve = [&](int lobe, DsbrdfCurve which) {
      return c.segment<spline_size>(from + curve_offset(lobe, which));
    };
    curve(0, DsbrdfCurve::kappa).setConstant(std::log(0.1 + 0.05 * channel));
    curve(0, DsbrdfCurve::gamma).setConstant(first_gamma);
    curve(1, DsbrdfCurve::kappa).setConstant(std::log(0.1));
    curve(1, DsbrdfCurve::gamma).setConstant(std::log(std::min(15.0, gamma)));
    curve(2, DsbrdfCurve::kappa).setLinSpaced(std::log(kappa), std::log(1.5 * kappa));
    curve(2, DsbrdfCurve::gamma).setLinSpaced(std::log(gamma), std::log(0.6 * gamma));
  }
  return Dsbrdf(c);
}

}  // namespace partwise::test
