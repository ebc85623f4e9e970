#include "partwise/appearance/rendering/light_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "partwise/appearance/rendering/halfway_table.h"
#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/appearance/rendering/shading_frame.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

// What is known of a patch while the pyramid is built: sums over its pixels.
struct Sums {
  Eigen::Vector3d radiance = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // each times the sum of its pixel's radiance

  double weight() const { return radiance.sum(); }
};

struct Level {
  int width = 0, height = 0;
  std::vector<Sums> sums{};

  const Sums& at(int x, int y) const { return sums[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + x]; }
};

constexpr int most_rows_at_top = 8;

Level pixels(const EnvironmentLight& light, const Eigen::Matrix3d& rotation) {
  Level level{light.width(), light.height()};
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      Sums& sums = level.sums.emplace_back();
      sums.radiance =
          light.solid_angle(y) * Eigen::Map<const Eigen::Vector3f>(light.radiance().pixel(x, y)).cast<double>();
      sums.direction = sums.weight() * (rotation * light.direction(x, y).cast<double>()).normalized();
    }
  }
  return level;
}

Level halved(const Level& fine) {
  Level level{(fine.width + 1) / 2, (fine.height + 1) / 2};
  level.sums.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      Sums& sums = level.sums[static_cast<std::size_t>(y / 2 * level.width + x / 2)];
      sums.radiance += fine.at(x, y).radiance;
      sums.direction += fine.at(x, y).direction;
    }
  }
  return level;
}

LightPatch patch_of(const Sums& sums, bool is_pixel) {
  LightPatch patch;
  const Eigen::Vector3d mean = sums.direction / sums.weight();
  const double length = mean.norm();
  // Patches at the top of small maps may bring as much from one side as from the other.
  const Eigen::Vector3d direction = length > 1e-6 ? Eigen::Vector3d(mean / length) : Eigen::Vector3d::UnitY();
  patch.direction = direction.cast<float>();
  patch.half = half_vector(direction).cast<float>();
  patch.radiance = sums.radiance.cast<float>();
  if (!is_pixel) patch.spread = static_cast<float>(std::sqrt(std::max(0.0, 2 - 2 * length)));
  return patch;
}

// The distance from the normal at which the sharpest lobe has lost half of its peak.
float sharpest_width(const Dsbrdf& material) {
  constexpr int steps = 16;
  double least = 1;
  for (int i = 0; i <= steps; ++i) {
    const DsbrdfLobes lobes = material.lobes(std::numbers::pi / 2 * i / steps);
    const Eigen::Array33d exponents = lobes.gamma.array().abs() * lobes.kappa.array().max(1);
    least = std::min(least, std::sqrt(2 * std::numbers::ln2 / std::max(1.0, exponents.maxCoeff())));
  }
  return static_cast<float>(least);
}

}  // namespace

LightTree::LightTree(const EnvironmentLight& light, const Eigen::Matrix3d& rotation) {
  std::vector<Level> levels{pixels(light, rotation)};
  while (levels.back().height > most_rows_at_top) levels.push_back(halved(levels.back()));
  struct Place {
    int level, x, y;
  };
  std::vector<Place> places;  // of the patches, level by level from the top
  const auto add = [&](int level, int x, int y) {
    const Level& of = levels[static_cast<std::size_t>(level)];
    if (x >= of.width || y >= of.height || !(of.at(x, y).weight() > 0)) return;
    places.push_back({level, x, y});
    patches_.push_back(patch_of(of.at(x, y), level == 0));
  };
  const int top = static_cast<int>(levels.size()) - 1;
  for (int y = 0; y < levels.back().height; ++y) {
    for (int x = 0; x < levels.back().width; ++x) add(top, x, y);
  }
  largest_ = static_cast<int>(patches_.size());
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    const Place at = places[i];
    if (at.level == 0) continue;
    const int first = static_cast<int>(patches_.size());
    for (const auto& [right, down] : {std::array{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      add(at.level - 1, 2 * at.x + right, 2 * at.y + down);
    patches_[i].first = first;
    patches_[i].children = static_cast<int>(patches_.size()) - first;
  }
  for (std::size_t i = patches_.size(); i-- > 0;) {  // children stand behind their parents
    LightPatch& patch = patches_[i];
    for (int k = patch.first; k < patch.first + patch.children; ++k) {
      const LightPatch& child = patches_[static_cast<std::size_t>(k)];
      patch.radius = std::max(patch.radius, (child.direction - patch.direction).norm() + child.radius);
    }
  }
}

PatchSum::PatchSum(const Brdf& material, const LightTree& light, double fineness)
    : material_(&material), light_(&light), fineness_(static_cast<float>(fineness)), sharpest_(0.004f) {
  PARTWISE_CHECK(fineness, >=, 0);
  if (const auto* dsbrdf = dynamic_cast<const Dsbrdf*>(&material)) {
    sharpest_ = sharpest_width(*dsbrdf);
    table_ = std::make_unique<HalfwayTable>(*dsbrdf);
  }
}

PatchSum::~PatchSum() = default;
PatchSum::PatchSum(PatchSum&&) noexcept = default;
PatchSum& PatchSum::operator=(PatchSum&&) noexcept = default;

// visit(patch, cosine) of those that are taken as a whole.
template <typename Visit>
void PatchSum::visit_cut(const Eigen::Vector3f& normal, const Visit& visit) const {
  constexpr float least_slope = 0.05f;  // of the half-vector against light from nearly straight behind
  constexpr float narrow = 0.03f;       // patches that need no care at the horizon
  const std::vector<LightPatch>& patches = light_->patches();
  std::array<int, 256> waiting;  // three more a level than are taken off
  for (int root = 0; root < light_->largest(); ++root) {
    std::size_t count = 0;
    waiting[count++] = root;
    while (count > 0) {
      const LightPatch& patch = patches[static_cast<std::size_t>(waiting[--count])];
      const float cosine = normal.dot(patch.direction);
      if (cosine <= -patch.radius) continue;
      if (patch.children > 0) {
        const float turned = patch.radius / (2 * std::max(patch.half.z(), least_slope));
        const float reach = fineness_ * std::max((normal - patch.half).norm(), sharpest_);
        if (turned > reach || (patch.radius > narrow && cosine < patch.radius)) {
          for (int k = patch.children - 1; k >= 0; --k) waiting[count++] = patch.first + k;
          continue;
        }
      }
      // The mean of its pixels' directions is shorter than 1 by half the square of the spread; so a matt surface is
      // exact.
      if (cosine > 0) visit(patch, cosine * (1 - patch.spread * patch.spread / 2));
    }
  }
}

Eigen::Vector3f PatchSum::colour(const Eigen::Vector3f& normal) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto add = [&](const LightPatch& patch, float cosine, const Eigen::Vector3f& value) {
    sum += (cosine * value.cwiseProduct(patch.radiance)).cast<double>();
  };
  if (table_ != nullptr) {
    visit_cut(normal, [&](const LightPatch& patch, float cosine) {
      add(patch, cosine, table_->value(patch.half.z(), (normal - patch.half).squaredNorm() / 2));
    });
  } else {
    const ShadingFrame frame(normal);
    visit_cut(normal, [&](const LightPatch& patch, float cosine) {
      add(patch, cosine, (*material_)(frame.local(patch.direction), frame.to_viewer));
    });
  }
  return sum.cast<float>();
}

std::vector<Eigen::Vector3f> PatchSum::colours(std::span<const Eigen::Vector3f> normals) const {
  std::vector<Eigen::Vector3f> result(normals.size());
  constexpr std::size_t grain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), grain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) result[i] = colour(normals[i]);
  });
  return result;
}

}  // namespace partwise
