// Light from far away, as an equirectangular map of radiance, and as the sum over directions that (3.2) takes
// (dissertation, section 3.3.1).
//
// Linear RGB. Column centres are at u = (x + 1/2) / width, rows at v = (y + 1/2) / height from +y down. Seen from the
// middle, the centre column faces -z, right of it is +x: direction (sin t sin p, cos t, -sin t cos p) with t = pi v,
// p = 2 pi (u - 1/2). A pixel's solid angle is (2 pi / width) (cos t_top - cos t_bottom), so that all add up to 4 pi.
// Energy is the sum of radiance times solid angle, by channel; resizing and rotating keep it.
// Errors: InputError for a map that is not RGB or holds NaN or infinite values; CheckFailed for sizes below 1.
#pragma once

#include <Eigen/Core>

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/imaging/image.h"

namespace partwise {

// The two formulas above, for a map of any size.
Eigen::Vector3d equirectangular_direction(int x, int y, int width, int height);
double equirectangular_solid_angle(int y, int width, int height);

class EnvironmentLight {
 public:
  // Negative values, which processed photographs may hold, become 0. Messages call the map `name`.
  explicit EnvironmentLight(Image radiance, const std::string& name = "light");

  int width() const { return radiance_.width; }
  int height() const { return radiance_.height; }
  const Image& radiance() const { return radiance_; }

  Eigen::Vector3f direction(int x, int y) const;  // of a pixel's centre, unit length
  double solid_angle(int y) const;                // of a pixel of row y
  Eigen::Vector3d energy() const;

  // A box filter on the sphere: each new pixel is the mean over its solid angle of the old ones. Any size, also larger.
  EnvironmentLight resized(int width, int height) const;

  // Turned about +y, counter-clockwise as seen from above: what came from -z comes from (-sin, 0, -cos). Whole columns
  // move as they are; between columns each pixel is shared between the two that it falls on.
  EnvironmentLight rotated(double degrees) const;

  // Bilinear between pixel centres, around the seam and, at the poles, across to the other side.
  Eigen::Vector3f sample(const Eigen::Vector3f& direction) const;

 private:
  Image radiance_;
};

// .exr or .hdr. Errors: those of reading as well.
EnvironmentLight read_light(const std::filesystem::path& path);
// One of data/lights by its name, for example "studio". Errors: InputError that names those there are.
EnvironmentLight shipped_light(const std::string& name);
std::vector<std::string> shipped_lights();  // in the order of the alphabet

// As people name a light: a shipped one, or a file (.exr, .hdr) relative to `folder`.
bool is_light_file(const std::string& name);
EnvironmentLight named_light(const std::string& name, const std::filesystem::path& folder = {});

// A light as directions with weights, radiance times solid angle. Pixels without light are left out; zeros fill the end
// up to a multiple of 8.
struct LightSamples {
  Eigen::ArrayXf x, y, z, red, green, blue;

  Eigen::Index size() const { return x.size(); }
  Eigen::Vector3f direction(Eigen::Index i) const { return {x[i], y[i], z[i]}; }
};

// The directions are those of the map turned by `rotation`, for example into camera space.
LightSamples light_samples(const EnvironmentLight& light,
                           const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

}  // namespace partwise
