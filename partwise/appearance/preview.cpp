#include "partwise/appearance/preview.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "partwise/appearance/preview_rays.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

using Vector = Eigen::Vector3f;
constexpr float pi = std::numbers::pi_v<float>;
constexpr float golden_angle = 2.3999632f;

// The light. Radiances are those of a matt white surface that would look as bright.
constexpr float key_cosine_gain = 0.88f;  // white surface facing the key light
constexpr float sky_zenith = 0.60f, sky_horizon = 0.42f, ground_bounce = 0.24f;
constexpr float between_surfaces = 0.30f;  // of a surface's colour comes back from what blocks its sky
constexpr float key_disk = 0.075f;         // tangent of the key light's angular radius

constexpr int pattern = 4;   // samples interleave over pattern x pattern subpixels
constexpr int sky_rays = 4;  // a subpixel
constexpr int sky_samples = pattern * pattern * sky_rays, key_samples = pattern * pattern;

enum class Seen : unsigned char { nothing, ground, surface };

struct Sample {  // what one subpixel sees
  Seen seen = Seen::nothing;
  Vector position, normal, colour;
  Vector sky = Vector::Zero();  // light from the sky and the ground
  float key = 0, blocked = 0;   // share of the key light that arrives; share of the sky that surfaces block
};

struct Light {
  std::array<Vector, sky_samples> sky;  // about +z, density proportional to the cosine
  std::array<Vector, key_samples> key;  // in the world
  Vector key_direction;
};

Light make_light(const PreviewCamera& camera) {
  Light light;
  for (int i = 0; i < sky_samples; ++i) {  // Roberts' R2 sequence on the disk, lifted to the hemisphere (Malley)
    const float u = std::fmod(0.5f + 0.7548777f * static_cast<float>(i), 1.0f);
    const float v = std::fmod(0.5f + 0.5698403f * static_cast<float>(i), 1.0f);
    const float r = std::sqrt(u), phi = 2 * pi * v;
    light.sky[static_cast<std::size_t>(i)] = {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
  }
  // From the upper left of the viewer.
  const Vector right = camera.axes.row(0).transpose().cast<float>();
  const Vector to_viewer = right.cross(Vector::UnitY());
  light.key_direction = (-0.55f * right + 1.05f * Vector::UnitY() + 0.6f * to_viewer).normalized();
  const Vector s = light.key_direction.unitOrthogonal(), t = light.key_direction.cross(s);
  for (int i = 0; i < key_samples; ++i) {
    const float r = key_disk * std::sqrt((static_cast<float>(i) + 0.5f) / key_samples);
    const float phi = golden_angle * static_cast<float>(i);
    light.key[static_cast<std::size_t>(i)] =
        (light.key_direction + r * std::cos(phi) * s + r * std::sin(phi) * t).normalized();
  }
  return light;
}

Vector sky_radiance(const Vector& direction) {
  const float up = direction.y();
  if (up < 0) return ground_bounce * Vector(1.03f, 1.0f, 0.95f);
  return (sky_horizon + (sky_zenith - sky_horizon) * std::sqrt(up)) * Vector(0.98f, 1.0f, 1.03f);
}

// What white ground far from everything gets.
float open_ground_light(const Light& light) {
  float sky = 0;
  for (const Vector& direction : light.sky) sky += sky_radiance({direction.x(), direction.z(), direction.y()}).y();
  return sky / sky_samples + key_cosine_gain * light.key_direction.y();
}

class Renderer {
 public:
  Renderer(const PreviewScene& scene, const PreviewCamera& camera, const PreviewSettings& settings)
      : rays_(scene),
        camera_(camera),
        settings_(settings),
        ground_(scene.ground),
        light_(make_light(camera)),
        width_(settings.width * settings.subpixels),
        height_(settings.height * settings.subpixels),
        samples_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

  Image render() {
    each_row(height_, [&](int y) {
      for (int x = 0; x < width_; ++x) sample(x, y) = trace(x, y);
    });
    Image image(settings_.width, settings_.height, 4);
    const float open_light = open_ground_light(light_);
    each_row(settings_.height, [&](int y) {
      for (int x = 0; x < settings_.width; ++x) resolve(x, y, open_light, image.pixel(x, y));
    });
    return image;
  }

 private:
  template <typename Body>
  static void each_row(int rows, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<int>(0, rows, 4), [&](const tbb::blocked_range<int>& range) {
      for (int y = range.begin(); y < range.end(); ++y) body(y);
    });
  }

  Sample& sample(int x, int y) {
    return samples_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }

  Sample trace(int x, int y) const {
    const double half_width = camera_.half_height * width_ / height_;
    const double across = (2 * (x + 0.5) / width_ - 1) * half_width;
    const double up = (1 - 2 * (y + 0.5) / height_) * camera_.half_height;
    const Eigen::Vector3d in_plane = camera_.axes.topRows<2>().transpose() * Eigen::Vector2d(across, up);
    const Eigen::Vector3d back = camera_.axes.row(2);
    Vector origin = camera_.position.transpose().cast<float>(), direction = -back.cast<float>();
    if (camera_.orthographic)
      origin += in_plane.cast<float>();
    else
      direction = (in_plane - back).normalized().cast<float>();

    Sample result;
    PreviewHit hit;
    if (rays_.first_hit(origin, direction, hit)) {
      result.seen = Seen::surface;
    } else if (!hit_ground(origin, direction, hit)) {
      return result;
    } else {
      result.seen = Seen::ground;
    }
    result.position = hit.position, result.normal = hit.normal, result.colour = hit.colour;
    const auto cell = static_cast<std::size_t>((y % pattern) * pattern + x % pattern);
    gather(cell, result);
    return result;
  }

  bool hit_ground(const Vector& origin, const Vector& direction, PreviewHit& hit) const {
    if (!ground_ || direction.y() >= 0 || origin.y() <= rays_.lowest()) return false;
    hit.position = origin + direction * ((rays_.lowest() - origin.y()) / direction.y());
    hit.position.y() = rays_.lowest() - 2e-5f * rays_.size();
    if ((hit.position - rays_.centre()).norm() > 3 * rays_.size()) return false;
    hit.normal = Vector::UnitY();
    hit.colour = Vector::Ones();
    return true;
  }

  void gather(std::size_t cell, Sample& result) const {
    // An orthonormal frame without branches (Duff et al. 2017).
    const Vector& n = result.normal;
    const float sign = std::copysign(1.0f, n.z()), a = -1 / (sign + n.z()), b = n.x() * n.y() * a;
    const Vector s(1 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()), t(b, sign + n.y() * n.y() * a, -n.y());
    Eigen::Matrix<float, 3, 4> directions;
    for (int i = 0; i < sky_rays; ++i) {  // sample numbers a pattern apart spread well themselves
      const Vector& local = light_.sky[cell + static_cast<std::size_t>(i * pattern * pattern)];
      directions.col(i) = local.x() * s + local.y() * t + local.z() * n;
    }
    const std::array<bool, 4> blocked = rays_.blocked(result.position, directions);
    for (int i = 0; i < sky_rays; ++i) {
      if (blocked[static_cast<std::size_t>(i)])
        result.blocked += 1.0f / sky_rays;
      else
        result.sky += sky_radiance(directions.col(i)) / sky_rays;
    }
    const Vector& key = light_.key[(cell * 7) % key_samples];
    if (result.normal.dot(light_.key_direction) > 0 && !rays_.blocked(result.position, key)) result.key = 1;
  }

  // The light of a subpixel: the mean over the 5 x 5 neighbours on the same smooth piece of surface. The weights along
  // a side, 1 2 2 2 1, give each of the pattern's cells the same weight.
  Vector filtered_light(int x, int y, const Sample& centre) {
    constexpr std::array<float, 5> side{1, 2, 2, 2, 1};
    const float reach = 0.004f * rays_.size();
    Vector sky = Vector::Zero();
    float key = 0, blocked = 0, total = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        if (x + dx < 0 || x + dx >= width_ || y + dy < 0 || y + dy >= height_) continue;
        const Sample& other = sample(x + dx, y + dy);
        if (other.seen != centre.seen || other.normal.dot(centre.normal) < 0.9f ||
            std::abs((other.position - centre.position).dot(centre.normal)) > reach) {
          continue;
        }
        const float weight = side[static_cast<std::size_t>(dx + 2)] * side[static_cast<std::size_t>(dy + 2)];
        sky += weight * other.sky;
        key += weight * other.key;
        blocked += weight * other.blocked;
        total += weight;
      }
    }
    const float facing = std::max(0.0f, centre.normal.dot(light_.key_direction));
    const Vector back = between_surfaces * (blocked / total) * centre.colour;
    return sky / total + back + Vector::Constant(key_cosine_gain * facing * key / total);
  }

  // How dark the ground's shadow looks. Shadows end softly before the picture does: faint outskirts are left out, and
  // what would cross the frame fades.
  float shadow_alpha(int x, int y, const Sample& ground, const Vector& light, float open_light) const {
    const int inward = std::min({x, y, width_ - 1 - x, height_ - 1 - y});
    const float frame = std::min(1.0f, static_cast<float>(inward) / (0.07f * static_cast<float>(width_)));
    const float ratio = std::clamp(light.y() / open_light, 0.0f, 1.0f);
    const float away = (ground.position - rays_.centre()).norm() / rays_.size();
    const float fade = std::clamp((1.4f - away) / 0.8f, 0.0f, 1.0f);
    return std::max(0.0f, 0.77f * frame * fade * (1 - std::pow(ratio, 1 / 2.2f)) - 0.02f);
  }

  void resolve(int px, int py, float open_light, float* pixel) {
    const int n = settings_.subpixels;
    Vector colour = Vector::Zero();
    float alpha = 0;
    for (int y = py * n; y < (py + 1) * n; ++y) {
      for (int x = px * n; x < (px + 1) * n; ++x) {
        const Sample& centre = sample(x, y);
        if (centre.seen == Seen::nothing) continue;
        const Vector light = filtered_light(x, y, centre);
        if (centre.seen == Seen::ground) {
          alpha += shadow_alpha(x, y, centre, light, open_light);
        } else {
          colour += centre.colour.cwiseProduct(light);
          alpha += 1;
        }
      }
    }
    if (alpha == 0) return;
    const Vector straight = colour / alpha;
    std::copy_n(straight.data(), 3, pixel);
    pixel[3] = alpha / static_cast<float>(n * n);
  }

  const PreviewRays rays_;
  const PreviewCamera camera_;
  const PreviewSettings settings_;
  const bool ground_;
  const Light light_;
  const int width_, height_;  // in subpixels
  std::vector<Sample> samples_;
};

}  // namespace

PreviewCamera frame_scene(const PreviewScene& scene, const PreviewView& view, double width_over_height) {
  std::vector<RoundPoints> bodies;
  for (const PreviewMesh& mesh : scene.meshes) bodies.push_back({&mesh.mesh.vertices, 0});
  for (const PreviewCurve& curve : scene.curves) bodies.push_back({&curve.points, curve.radius});
  for (const PreviewPoints& points : scene.points) bodies.push_back({&points.points, points.radius});
  return frame_points(bodies, view, width_over_height);
}

Image render_preview(const PreviewScene& scene, const PreviewCamera& camera, const PreviewSettings& settings) {
  PARTWISE_CHECK(settings.width, >=, 1);
  PARTWISE_CHECK(settings.height, >=, 1);
  PARTWISE_CHECK(settings.subpixels, >=, 1);
  return Renderer(scene, camera, settings).render();
}

}  // namespace partwise
