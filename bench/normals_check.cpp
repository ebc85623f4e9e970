// Normals of measured depth beside those of planes that are fitted plainly: for a grid of pixels, the points of a
// square window whose depth differs from the pixel's by at most 5 % (Silberman and others 2012), and the plane that
// explains their inverse depths best ("inverse"), or that is nearest to them in space ("space"). All have the same
// radius.
//
//   normals_check FOLDER... [--radii 0 7 14] [--pictures DIR]    angles between normals_from_depth and these
//   normals_check --planes [--radii 0 5 10]    angles of all to the truth, of slanted planes as a sensor sees them
//
// One JSON line a frame and radius, angles in degrees, with the share of the pixels with a depth that have a normal and
// the time that normals_from_depth takes. Radius 0: the settings' own, and no planes beside it.
#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/depth_sensor.h"
#include "partwise/normals/truth/normal_files.h"
#include "partwise/normals/truth/rgbd_folder.h"

namespace {

using namespace partwise;
using Eigen::Vector3d;

constexpr double most_difference = 0.05;  // of depth
constexpr int grid = 5;                   // every fifth pixel of every fifth row

std::vector<Vector3d> points_about(const Image& depth, const PinholeCamera& camera, int x, int y, int radius) {
  const auto here = static_cast<double>(depth.pixel(x, y)[0]);
  std::vector<Vector3d> points;
  for (int j = std::max(0, y - radius); j <= std::min(depth.height - 1, y + radius); ++j) {
    for (int i = std::max(0, x - radius); i <= std::min(depth.width - 1, x + radius); ++i) {
      const auto z = static_cast<double>(depth.pixel(i, j)[0]);
      if (z > 0 && std::abs(z - here) <= most_difference * here) points.emplace_back(z * camera.ray(i, j));
    }
  }
  return points;
}

Vector3d plane_in_space(const std::vector<Vector3d>& points) {
  Vector3d mean = Vector3d::Zero();
  for (const Vector3d& each : points) mean += each / static_cast<double>(points.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Vector3d& each : points) scatter += (each - mean) * (each - mean).transpose();
  const Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvectors().col(0);
  return normal.dot(mean) < 0 ? normal : Vector3d(-normal);
}

// Of n . X = -1 divided by the depth.
Vector3d plane_of_inverse_depth(const std::vector<Vector3d>& points) {
  Eigen::MatrixX3d rays(points.size(), 3);
  Eigen::VectorXd inverse(points.size());
  for (Eigen::Index i = 0; i < rays.rows(); ++i) {
    inverse[i] = -1 / points[static_cast<std::size_t>(i)].z();
    rays.row(i) = inverse[i] * points[static_cast<std::size_t>(i)].transpose();
  }
  const Vector3d plane = rays.colPivHouseholderQr().solve(-inverse);
  return plane.normalized();
}

struct Angles {
  std::vector<double> degrees;
  void add(const Vector3d& a, const Vector3d& b) {
    degrees.push_back(std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::numbers::pi);
  }
  nlohmann::json quantiles() {
    std::ranges::sort(degrees);
    const auto at = [&](double share) {
      return degrees[static_cast<std::size_t>(share * static_cast<double>(degrees.size() - 1))];
    };
    return {{"median", at(0.5)}, {"p75", at(0.75)}, {"p90", at(0.9)}};
  }
};

// Of all to the truth where it is known, else of the plain planes to ours.
nlohmann::json compare(const Image& depth, const PinholeCamera& camera, int radius,
                       const std::optional<Vector3d>& truth) {
  DepthNormalSettings settings;
  if (radius > 0) settings.least_radius = settings.most_radius = radius;
  const auto start = std::chrono::steady_clock::now();
  const Image normals = normals_from_depth(depth, camera, settings);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const Mask known = known_normals(normals);
  const auto depths = std::ranges::count_if(depth.values, [](float z) { return z > 0; });
  const auto found = std::ranges::count(known.values, 1.0f);
  nlohmann::json line{{"radius", radius},
                      {"known", static_cast<double>(found) / static_cast<double>(depths)},
                      {"seconds", seconds.count()}};
  Angles own, inverse, space;
  for (int y = 0; y < normals.height; y += grid) {
    for (int x = 0; x < normals.width; x += grid) {
      const std::vector<Vector3d> points = points_about(depth, camera, x, y, radius);
      if (known.pixel(x, y)[0] == 0 || (radius > 0 && std::ssize(points) < settings.least_pixels)) continue;
      const Vector3d normal = Eigen::Map<const Eigen::Vector3f>(normals.pixel(x, y)).cast<double>();
      if (truth) own.add(normal, *truth);
      if (radius == 0) continue;
      inverse.add(truth.value_or(normal), plane_of_inverse_depth(points));
      space.add(truth.value_or(normal), plane_in_space(points));
    }
  }
  if (truth) line["own"] = own.quantiles();
  if (radius > 0) line["inverse"] = inverse.quantiles(), line["space"] = space.quantiles();
  return line;
}

void compare_frames(const std::string& folder, const std::vector<int>& radii, const std::filesystem::path& pictures) {
  for (const RgbdFiles& files : find_rgbd_frames(folder)) {
    const RgbdFrame frame = read_rgbd_frame(files);
    if (!pictures.empty()) {
      write_normals(pictures / files.depth.filename().replace_extension(".png"),
                    normals_from_depth(frame.depth, frame.camera), NormalBits::eight);
    }
    for (const int radius : radii) {
      nlohmann::json line = compare(frame.depth, frame.camera, radius, {});
      line["depth"] = files.depth.filename().string();
      std::cout << line.dump() << std::endl;
    }
  }
}

void compare_planes(const std::vector<int>& radii) {
  constexpr PinholeCamera camera{525, 525, 319.5, 239.5};
  for (const double metres : {1.0, 2.0, 3.5}) {
    for (const double slant : {0.0, 40.0, 65.0}) {
      const double radians = slant * std::numbers::pi / 180;
      const Vector3d normal(std::sin(radians) / 2, std::sin(radians) * std::sqrt(0.75), std::cos(radians));
      Image depth(640, 480, 1), normals(640, 480, 3);
      for (int y = 0; y < depth.height; ++y) {
        for (int x = 0; x < depth.width; ++x) {
          const double z = -metres * normal.z() / normal.dot(camera.ray(x, y));
          depth.pixel(x, y)[0] = z > 0 ? static_cast<float>(z) : 0;
          Eigen::Map<Eigen::Vector3f>(normals.pixel(x, y)) = normal.cast<float>();
        }
      }
      const Image sensed = sensed_depth(depth, normals, camera, {}, 1);
      for (const int radius : radii) {
        nlohmann::json line = compare(sensed, camera, radius, normal);
        line["metres"] = metres, line["slant"] = slant;
        std::cout << line.dump() << std::endl;
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Normals of measured depth beside planes that are fitted plainly");
  std::vector<std::string> folders;
  std::vector<int> radii{0, 5, 7, 10, 14};
  std::filesystem::path pictures;
  bool planes = false;
  app.add_option("FOLDER", folders, "Folders of frames");
  app.add_flag("--planes", planes, "Planes as a sensor sees them");
  app.add_option("--radii", radii, "Of all, pixels; 0: the settings' own");
  app.add_option("--pictures", pictures, "Write the frames' normals there");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& folder : folders) compare_frames(folder, radii, pictures);
    if (planes) compare_planes(radii);
  } catch (const partwise::InputError& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
