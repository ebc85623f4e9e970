#include "partwise/editing/drawn_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace partwise {
namespace {

constexpr double radians = std::numbers::pi / 180;

using Colour = Eigen::Array3f;

Colour drawn_tint(Draw& draw, double stops) {
  Colour tint;
  for (float& each : tint) each = static_cast<float>(std::exp2(draw.within(-stops, stops)));
  return tint;
}

// sum += light, times a colour.
void add(Image& sum, const Image& light, const Colour& colour) {
  for (std::size_t i = 0; i < sum.values.size(); ++i)
    sum.values[i] += colour[static_cast<Eigen::Index>(i % 3)] * light.values[i];
}

Image mirrored(Image light) {
  for (int y = 0; y < light.height; ++y) {
    for (int left = 0, right = light.width - 1; left < right; ++left, --right)
      std::swap_ranges(light.pixel(left, y), light.pixel(left, y) + 3, light.pixel(right, y));
  }
  return light;
}

EnvironmentLight photographed(Draw& draw, const std::vector<EnvironmentLight>& maps) {
  const auto any = [&] {
    const EnvironmentLight turned =
        maps[static_cast<std::size_t>(draw.below(static_cast<int>(maps.size())))].rotated(360 * draw.unit());
    return draw.unit() < 0.5 ? turned : EnvironmentLight(mirrored(turned.radiance()));
  };
  const EnvironmentLight first = any();
  Image radiance(first.width(), first.height(), 3);
  add(radiance, first.radiance(), drawn_tint(draw, 0.25));
  if (draw.unit() < 0.5) {
    const EnvironmentLight second = any();
    const double share = std::exp2(draw.within(-3, 0)) * first.energy().mean() / std::max(second.energy().mean(), 1e-9);
    add(radiance, second.radiance(), static_cast<float>(share) * drawn_tint(draw, 0.25));
  }
  return EnvironmentLight(std::move(radiance));
}

struct Lamp {
  Eigen::Vector3f direction;
  float radius;  // radians, half way down the soft edge
  Colour radiance;

  static Lamp drawn(Draw& draw) {
    const double lowest = std::sin(-10 * radians);
    const double y = draw.within(lowest, 1), around = 2 * std::numbers::pi * draw.unit(), across = std::sqrt(1 - y * y);
    const double radius = std::exp(draw.within(std::log(4 * radians), std::log(25 * radians)));
    // Of comparable energy whatever the size.
    const double brightness = std::exp2(draw.within(-2, 0)) / (1 - std::cos(radius));
    const Eigen::Vector3d direction(across * std::cos(around), y, across * std::sin(around));
    return {direction.cast<float>(), static_cast<float>(radius),
            static_cast<float>(brightness) * drawn_tint(draw, 0.5)};
  }
  Colour from(const Eigen::Vector3f& seen) const {
    constexpr float edge = 0.3f;  // of the radius, on either side
    const float angle = std::acos(std::clamp(seen.dot(direction), -1.0f, 1.0f));
    const float in = std::clamp((radius * (1 + edge) - angle) / (2 * edge * radius), 0.0f, 1.0f);
    return radiance * (in * in * (3 - 2 * in));
  }
};

EnvironmentLight lamps(Draw& draw, int width, int height) {
  std::vector<Lamp> all(static_cast<std::size_t>(1 + draw.below(4)));
  for (Lamp& each : all) each = Lamp::drawn(draw);
  const Colour top = drawn_tint(draw, 1), bottom = drawn_tint(draw, 1);
  const double share = draw.within(0.1, 0.7);
  Image lit(width, height, 3), sky(width, height, 3);
  const EnvironmentLight directions(Image(width, height, 3));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Eigen::Vector3f seen = directions.direction(x, y);
      Colour sum = Colour::Zero();
      for (const Lamp& each : all) sum += each.from(seen);
      Eigen::Map<Colour>(lit.pixel(x, y)) = sum;
      Eigen::Map<Colour>(sky.pixel(x, y)) = bottom + (top - bottom) * (0.5f + 0.5f * seen.y());
    }
  }
  const double ratio = EnvironmentLight(lit).energy().mean() / EnvironmentLight(sky).energy().mean();
  add(lit, sky, Colour::Constant(static_cast<float>(ratio * share / (1 - share))));
  return EnvironmentLight(std::move(lit));
}

}  // namespace

EnvironmentLight drawn_light(Draw& draw, const std::vector<EnvironmentLight>& maps) {
  if (draw.unit() < 0.25) return lamps(draw, maps.front().width(), maps.front().height());
  return photographed(draw, maps);
}

}  // namespace partwise
