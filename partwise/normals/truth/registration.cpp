#include "partwise/normals/truth/registration.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "partwise/base/error.h"

namespace partwise {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// In units of the focal length, y down.
Vector2d image_point(const PinholeCamera& camera, double column, double row) {
  return {(column - camera.centre_x) / camera.focal_x, (row - camera.centre_y) / camera.focal_y};
}

Vector2d pixel_of(const PinholeCamera& camera, const Vector2d& point) {
  return {camera.centre_x + camera.focal_x * point.x(), camera.centre_y + camera.focal_y * point.y()};
}

Image undistorted_colour(const Image& colour, const PinholeCamera& camera, const LensDistortion& lens) {
  Image result(colour.width, colour.height, colour.channels);
  tbb::parallel_for(0, colour.height, [&](int y) {
    for (int x = 0; x < colour.width; ++x) {
      const Vector2d from = pixel_of(camera, distorted(lens, image_point(camera, x, y)));
      const int left = static_cast<int>(std::floor(from.x())), top = static_cast<int>(std::floor(from.y()));
      const auto right_share = static_cast<float>(from.x() - left), low_share = static_cast<float>(from.y() - top);
      const int right = right_share > 0 ? left + 1 : left, low = low_share > 0 ? top + 1 : top;
      if (left < 0 || top < 0 || right >= colour.width || low >= colour.height) continue;
      for (int k = 0; k < colour.channels; ++k) {
        const float upper = std::lerp(colour.pixel(left, top)[k], colour.pixel(right, top)[k], right_share);
        const float lower = std::lerp(colour.pixel(left, low)[k], colour.pixel(right, low)[k], right_share);
        result.pixel(x, y)[k] = std::lerp(upper, lower, low_share);
      }
    }
  });
  return result;
}

Image depth_in_colour_camera(const Image& depth, const DepthRig& rig) {
  Image result(depth.width, depth.height, 1);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const auto z = static_cast<double>(depth.pixel(x, y)[0]);
      if (!(z > 0)) continue;
      const Vector2d seen = undistorted(rig.depth_lens, image_point(rig.depth_camera, x, y));
      const Vector3d point = rig.rotation * Vector3d(z * seen.x(), -z * seen.y(), -z) + rig.offset;
      const double distance = -point.z();
      if (!(distance > 0)) continue;
      const Vector2d pixel = pixel_of(rig.colour_camera, Vector2d(point.x(), -point.y()) / distance);
      if (!(pixel.x() > -0.5 && pixel.y() > -0.5 && pixel.x() < depth.width - 0.5 && pixel.y() < depth.height - 0.5)) {
        continue;
      }
      float& there =
          result.pixel(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())))[0];
      if (there == 0 || distance < static_cast<double>(there)) there = static_cast<float>(distance);
    }
  }
  return result;
}

}  // namespace

Vector2d distorted(const LensDistortion& lens, const Vector2d& point) {
  const double x = point.x(), y = point.y(), square = point.squaredNorm();
  const double radial = 1 + square * (lens.radial[0] + square * (lens.radial[1] + square * lens.radial[2]));
  const auto [p, q] = lens.tangential;
  return {x * radial + 2 * p * x * y + q * (square + 2 * x * x), y * radial + p * (square + 2 * y * y) + 2 * q * x * y};
}

// By repeated correction, which converges where distortion is weak, as in every camera that is used to measure.
Vector2d undistorted(const LensDistortion& lens, const Vector2d& image) {
  constexpr int most_corrections = 40;
  constexpr double far_below_a_pixel = 1e-10;
  Vector2d point = image;
  for (int i = 0; i < most_corrections; ++i) {
    const Vector2d error = image - distorted(lens, point);
    point += error;
    if (error.squaredNorm() < far_below_a_pixel * far_below_a_pixel) break;
  }
  return point;
}

DepthRig nyu_rig() {
  DepthRig rig;
  rig.depth_camera = read_rgbd_camera({RgbdFormat::nyu, {}, {}}, 640, 480);
  rig.depth_lens = {{-0.099897236553084481, 0.39065324602765344, -0.51031725053400578},
                    {0.0019290592870229277, -0.0019422022475975055}};
  rig.colour_camera = {518.85790117450188, 519.46961112127485, 325.58244941119034, 253.73616633400465};
  rig.colour_lens = {{0.20796615318809061, -0.58613825163911781, 0.49856986684705107},
                     {0.00072231363135888329, 0.0010479627195765181}};
  // The toolbox has y down and z away, and lists the matrix by columns.
  Eigen::Matrix3d rotation;
  rotation << 0.99997798940829263, -0.0050359919480810989, -0.0043196624923060242,  //
      0.0050518419386157446, 0.99998051861143999, 0.0036662365748484798,            //
      0.0043011152014118693, -0.0036879781309514218, 0.99998394948385538;
  const Vector3d turned(1, -1, -1);
  rig.rotation = turned.asDiagonal() * rotation * turned.asDiagonal();
  rig.offset = -turned.cwiseProduct(Vector3d(0.025031875059141302, 0.00066238747008330102, -0.00029342312935846411));
  return rig;
}

RgbdFrame registered_frame(const RgbdFrame& frame, const DepthRig& rig) {
  PARTWISE_CHECK(frame.depth.channels, ==, 1);
  PARTWISE_CHECK(frame.colour.width, ==, frame.depth.width);
  PARTWISE_CHECK(frame.colour.height, ==, frame.depth.height);
  return {undistorted_colour(frame.colour, rig.colour_camera, rig.colour_lens),
          depth_in_colour_camera(frame.depth, rig), rig.colour_camera};
}

RgbdFrame read_registered_frame(const RgbdFiles& files) {
  const RgbdFrame frame = read_rgbd_frame(files);
  return files.format == RgbdFormat::nyu ? registered_frame(frame, nyu_rig()) : frame;
}

}  // namespace partwise
