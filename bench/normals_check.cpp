// Normals of measured depth beside those of planes that are fitted plainly: for a grid of pixels, the points of a
// square window whose depth differs from the pixel's by at most 5 % (Silberman and others 2012), and the plane that
// explains their inverse depths best ("inverse"), or that is nearest to them in space ("space"). All have the same
// radius. One JSON line a frame and radius: angles between normals_from_depth and these in degrees, the share of the
// pixels with a depth that have a normal, and the time that normals_from_depth takes. Radius 0: the settings' own,
// nothing beside them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/normals/truth/depth_normals.h"
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
    degrees.push_back(std::acos(std::clamp(a.dot(b), -1.0, 1.0)) * 180 / std::numbers::pi);
  }
  nlohmann::json quantiles() {
    std::ranges::sort(degrees);
    const auto at = [&](double share) {
      return degrees[static_cast<std::size_t>(share * static_cast<double>(degrees.size() - 1))];
    };
    return {{"median", at(0.5)}, {"p75", at(0.75)}, {"p90", at(0.9)}};
  }
};

nlohmann::json compare(const RgbdFrame& frame, int radius) {
  DepthNormalSettings settings;
  if (radius > 0) settings.least_radius = settings.most_radius = radius;
  const auto start = std::chrono::steady_clock::now();
  const Image normals = normals_from_depth(frame.depth, frame.camera, settings);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const Mask known = known_normals(normals);
  const auto depths = std::ranges::count_if(frame.depth.values, [](float z) { return z > 0; });
  const auto found = std::ranges::count(known.values, 1.0f);
  nlohmann::json line{{"radius", radius},
                      {"known", static_cast<double>(found) / static_cast<double>(depths)},
                      {"seconds", seconds.count()}};
  if (radius == 0) return line;
  Angles inverse, space;
  for (int y = 0; y < normals.height; y += grid) {
    for (int x = 0; x < normals.width; x += grid) {
      const std::vector<Vector3d> points = points_about(frame.depth, frame.camera, x, y, radius);
      if (known.pixel(x, y)[0] == 0 || static_cast<int>(points.size()) < settings.least_pixels) continue;
      const Vector3d normal = Eigen::Map<const Eigen::Vector3f>(normals.pixel(x, y)).cast<double>();
      inverse.add(normal, plane_of_inverse_depth(points));
      space.add(normal, plane_in_space(points));
    }
  }
  line["inverse"] = inverse.quantiles();
  line["space"] = space.quantiles();
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Normals of measured depth beside planes that are fitted plainly");
  std::vector<std::string> folders;
  std::vector<int> radii{0, 5, 7, 10, 14};
  app.add_option("FOLDER", folders, "Folders of frames")->required();
  app.add_option("--radii", radii, "Of all, pixels; 0: the settings' own");
  std::filesystem::path pictures;
  app.add_option("--pictures", pictures, "Write the normals there");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& folder : folders) {
      for (const RgbdFiles& files : find_rgbd_frames(folder)) {
        const RgbdFrame frame = read_rgbd_frame(files);
        for (const int radius : radii) {
          nlohmann::json line = compare(frame, radius);
          if (!pictures.empty() && radius == 0) {
            write_normals(pictures / files.depth.filename().replace_extension(".png"),
                          normals_from_depth(frame.depth, frame.camera), NormalBits::eight);
          }
          line["depth"] = files.depth.filename().string();
          std::cout << line.dump() << std::endl;
        }
      }
    }
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
