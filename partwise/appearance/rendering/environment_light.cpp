#include "partwise/appearance/rendering/environment_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "partwise/base/error.h"
#include "partwise/base/shared_files.h"
#include "partwise/imaging/image_io.h"

namespace partwise {
namespace {

constexpr double pi = std::numbers::pi;
const std::filesystem::path shelf = std::filesystem::path("data") / "lights";

double polar_cosine(int row, int height) { return std::cos(pi * row / height); }  // of the upper edge of a row

// Which old intervals a new one covers, and what part of the new one each makes up. Edges rise from edge(0).
struct Share {
  int index;
  double share;
};

template <typename Edge>
std::vector<std::vector<Share>> shares(int from, int to, const Edge& edge) {
  std::vector<std::vector<Share>> result(static_cast<std::size_t>(to));
  for (int i = 0, j = 0; i < to; ++i) {
    const double low = edge(i, to), high = edge(i + 1, to);
    while (j > 0 && edge(j, from) > low) --j;
    for (; j < from && edge(j, from) < high; ++j) {
      const double overlap = std::min(high, edge(j + 1, from)) - std::max(low, edge(j, from));
      if (overlap > 0) result[static_cast<std::size_t>(i)].push_back({j, overlap / (high - low)});
    }
    if (j > 0) --j;
  }
  return result;
}

int wrapped(int x, int width) { return ((x % width) + width) % width; }

}  // namespace

EnvironmentLight::EnvironmentLight(Image radiance, const std::string& name) : radiance_(std::move(radiance)) {
  if (radiance_.channels != 3) {
    throw InputError(name, fmt::format("has {} channels", radiance_.channels), "give a map of red, green and blue");
  }
  for (float& value : radiance_.values) {
    if (!std::isfinite(value)) throw InputError(name, "holds a value that is not finite", "give a map without NaN");
    value = std::max(value, 0.0f);
  }
}

Eigen::Vector3d equirectangular_direction(int x, int y, int width, int height) {
  const double t = pi * (y + 0.5) / height, p = 2 * pi * ((x + 0.5) / width - 0.5);
  return {std::sin(t) * std::sin(p), std::cos(t), -std::sin(t) * std::cos(p)};
}

double equirectangular_solid_angle(int y, int width, int height) {
  return 2 * pi / width * (polar_cosine(y, height) - polar_cosine(y + 1, height));
}

Eigen::Vector3f EnvironmentLight::direction(int x, int y) const {
  return equirectangular_direction(x, y, width(), height()).cast<float>();
}

double EnvironmentLight::solid_angle(int y) const { return equirectangular_solid_angle(y, width(), height()); }

Eigen::Vector3d EnvironmentLight::energy() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int y = 0; y < height(); ++y) {
    Eigen::Vector3d row = Eigen::Vector3d::Zero();
    for (int x = 0; x < width(); ++x) row += Eigen::Map<const Eigen::Vector3f>(radiance_.pixel(x, y)).cast<double>();
    sum += solid_angle(y) * row;
  }
  return sum;
}

EnvironmentLight EnvironmentLight::resized(int new_width, int new_height) const {
  PARTWISE_CHECK(new_width, >=, 1);
  PARTWISE_CHECK(new_height, >=, 1);
  const auto columns = shares(width(), new_width, [](int i, int count) { return static_cast<double>(i) / count; });
  const auto rows = shares(height(), new_height, [](int i, int count) { return -polar_cosine(i, count); });
  Image result(new_width, new_height, 3);
  std::vector<Eigen::Vector3d> squeezed(static_cast<std::size_t>(width()));
  for (int y = 0; y < new_height; ++y) {
    std::ranges::fill(squeezed, Eigen::Vector3d::Zero());
    for (const auto& [old_y, share] : rows[static_cast<std::size_t>(y)]) {
      for (int x = 0; x < width(); ++x) {
        squeezed[static_cast<std::size_t>(x)] +=
            share * Eigen::Map<const Eigen::Vector3f>(radiance_.pixel(x, old_y)).cast<double>();
      }
    }
    for (int x = 0; x < new_width; ++x) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const auto& [old_x, share] : columns[static_cast<std::size_t>(x)]) {
        sum += share * squeezed[static_cast<std::size_t>(old_x)];
      }
      Eigen::Map<Eigen::Vector3f>(result.pixel(x, y)) = sum.cast<float>();
    }
  }
  return EnvironmentLight(std::move(result));
}

EnvironmentLight EnvironmentLight::rotated(double degrees) const {
  PARTWISE_CHECK(std::isfinite(degrees), ==, true);
  // Counter-clockwise from above is to the left on the map. Rounding must not spoil a whole number of columns.
  double shift = -std::fmod(degrees, 360.0) / 360 * width();
  if (std::abs(shift - std::round(shift)) < 1e-9 * width()) shift = std::round(shift);
  const int whole = static_cast<int>(std::floor(shift));
  const auto part = static_cast<float>(shift - whole);
  Image result(width(), height(), 3);
  for (int y = 0; y < height(); ++y) {
    for (int x = 0; x < width(); ++x) {
      const float* right = radiance_.pixel(wrapped(x - whole, width()), y);
      const float* left = radiance_.pixel(wrapped(x - whole - 1, width()), y);
      for (int k = 0; k < 3; ++k) result.pixel(x, y)[k] = (1 - part) * right[k] + part * left[k];
    }
  }
  return EnvironmentLight(std::move(result));
}

Eigen::Vector3f EnvironmentLight::sample(const Eigen::Vector3f& direction) const {
  const Eigen::Vector3d d = direction.cast<double>().normalized();
  const double across = (std::atan2(d.x(), -d.z()) / (2 * pi) + 0.5) * width() - 0.5;
  const double down = std::atan2(std::hypot(d.x(), d.z()), d.y()) / pi * height() - 0.5;
  const int x = static_cast<int>(std::floor(across)), y = static_cast<int>(std::floor(down));
  const auto pixel = [&](int column, int row) -> Eigen::Vector3d {
    if (row < 0 || row >= height()) column += width() / 2;  // across the pole
    return Eigen::Map<const Eigen::Vector3f>(
               radiance_.pixel(wrapped(column, width()), std::clamp(row, 0, height() - 1)))
        .cast<double>();
  };
  const double fx = across - x, fy = down - y;
  return ((1 - fy) * ((1 - fx) * pixel(x, y) + fx * pixel(x + 1, y)) +
          fy * ((1 - fx) * pixel(x, y + 1) + fx * pixel(x + 1, y + 1)))
      .cast<float>();
}

EnvironmentLight read_light(const std::filesystem::path& path) {
  return EnvironmentLight(read_image(path), path.string());
}

std::vector<std::string> shipped_lights() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(shared_file(shelf))) {
    if (entry.path().extension() == ".exr") names.push_back(entry.path().stem().string());
  }
  std::ranges::sort(names);
  return names;
}

EnvironmentLight shipped_light(const std::string& name) {
  const std::vector<std::string> names = shipped_lights();
  if (std::ranges::find(names, name) == names.end()) {
    throw InputError(fmt::format("light '{}'", name), "is not one of those that ship",
                     fmt::format("take one of {}, or a file", fmt::join(names, ", ")));
  }
  return read_light(shared_file(shelf / (name + ".exr")));
}

bool is_light_file(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  return ending == ".exr" || ending == ".hdr";
}

EnvironmentLight named_light(const std::string& name, const std::filesystem::path& folder) {
  return is_light_file(name) ? read_light(folder / name) : shipped_light(name);
}

LightSamples light_samples(const EnvironmentLight& light, const Eigen::Matrix3d& rotation) {
  constexpr Eigen::Index together = 8;
  const Image& radiance = light.radiance();
  Eigen::Index lit = 0;
  for (std::size_t i = 0; i < radiance.values.size(); i += 3) {
    lit += std::any_of(&radiance.values[i], &radiance.values[i] + 3, [](float value) { return value > 0; });
  }
  const Eigen::Index size = (lit + together - 1) / together * together;
  const Eigen::ArrayXf zeros = Eigen::ArrayXf::Zero(size);
  LightSamples samples{zeros, zeros, zeros, zeros, zeros, zeros};
  samples.z.setOnes();  // where nothing comes from, a unit vector still
  Eigen::Index at = 0;
  for (int y = 0; y < light.height(); ++y) {
    const auto solid_angle = static_cast<float>(light.solid_angle(y));
    for (int x = 0; x < light.width(); ++x) {
      const float* rgb = radiance.pixel(x, y);
      if (!(rgb[0] > 0 || rgb[1] > 0 || rgb[2] > 0)) continue;
      const Eigen::Vector3f d = (rotation * light.direction(x, y).cast<double>()).normalized().cast<float>();
      samples.x[at] = d.x(), samples.y[at] = d.y(), samples.z[at] = d.z();
      samples.red[at] = solid_angle * rgb[0];
      samples.green[at] = solid_angle * rgb[1];
      samples.blue[at] = solid_angle * rgb[2];
      ++at;
    }
  }
  return samples;
}

}  // namespace partwise
