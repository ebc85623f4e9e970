#include "partwise/appearance/rendering/reflectance_map.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "partwise/appearance/rendering/halfway_table.h"
#include "partwise/appearance/rendering/normal_disk.h"
#include "partwise/appearance/rendering/tabulated_material.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

using namespace float8;

constexpr int together = 8;

// Components of a block of normals, eight at a time; the last is repeated, with no use made of it.
struct NormalBlock {
  std::vector<float> x, y, z;

  explicit NormalBlock(std::span<const Eigen::Vector3f> normals) {
    const std::size_t size = (normals.size() + together - 1) / together * together;
    for (std::size_t i = 0; i < size; ++i) {
      const Eigen::Vector3f& n = normals[std::min(i, normals.size() - 1)];
      x.push_back(n.x()), y.push_back(n.y()), z.push_back(n.z());
    }
  }
};

// Adds what one light sample sends: sums has four floats a normal. `row` holds the material times the light's weight.
void add_sample(const Eigen::Vector3f& light, const Eigen::Vector3f& half, const NormalBlock& normals,
                const HalfwayTable::Row& row, float* sums) {
  using Float4 = float __attribute__((vector_size(16)));
  for (std::size_t i = 0; i < normals.x.size(); i += together) {
    const Float8 x = load(&normals.x[i]), y = load(&normals.y[i]), z = load(&normals.z[i]);
    Float8 cosine = light.x() * x + light.y() * y + light.z() * z;
    if (!any_positive(cosine)) continue;
    cosine = largest(cosine, all(0));
    const Float8 dx = x - half.x(), dy = y - half.y(), dz = z - half.z();
    const Float8 place = HalfwayTable::place(0.5f * (dx * dx + dy * dy + dz * dz));
    const Int8 whole = to_int(place);
    const Float8 part = place - to_float(whole);
    for (int k = 0; k < together; ++k) {
      Float4 low, high, sum;
      float* const target = sums + 4 * (i + static_cast<std::size_t>(k));
      std::memcpy(&low, row.data() + 4 * whole[k], sizeof(low));
      std::memcpy(&high, row.data() + 4 * whole[k] + 4, sizeof(high));
      std::memcpy(&sum, target, sizeof(sum));
      sum += cosine[k] * (low + part[k] * (high - low));
      std::memcpy(target, &sum, sizeof(sum));
    }
  }
}

// Blocks of normals times blocks of light samples are summed apart and then together in the order of the light, so that
// the result does not depend on who did which.
std::vector<Eigen::Vector3f> table_colours(const HalfwayTable& table, const LightSamples& light,
                                           std::span<const Eigen::Vector3f> normals) {
  constexpr std::size_t block = 4096, light_blocks = 8;
  const Eigen::ArrayX3f half = half_vectors(light);
  const std::size_t normal_blocks = (normals.size() + block - 1) / block;
  std::vector<std::vector<float>> sums(normal_blocks * light_blocks);
  tbb::parallel_for(tbb::blocked_range2d<std::size_t>(0, normal_blocks, 1, 0, light_blocks, 1), [&](const auto& range) {
    for (std::size_t b = range.rows().begin(); b < range.rows().end(); ++b) {
      const NormalBlock some(normals.subspan(b * block, std::min(block, normals.size() - b * block)));
      for (std::size_t part = range.cols().begin(); part < range.cols().end(); ++part) {
        std::vector<float>& sum = sums[b * light_blocks + part];
        sum.assign(4 * some.x.size(), 0);
        HalfwayTable::Row row;
        const auto samples = static_cast<std::size_t>(light.size());
        for (std::size_t i = part * samples / light_blocks; i < (part + 1) * samples / light_blocks; ++i) {
          const auto at = static_cast<Eigen::Index>(i);
          const Eigen::Vector3f h = half.row(at).transpose();
          table.row(std::acos(std::clamp(h.z(), 0.0f, 1.0f)), {light.red[at], light.green[at], light.blue[at]}, row);
          add_sample(light.direction(at), h, some, row, sum.data());
        }
      }
    }
  });
  std::vector<Eigen::Vector3f> colours(normals.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t part = 0; part < light_blocks; ++part) {
      colours[i] += Eigen::Map<const Eigen::Vector3f>(&sums[i / block * light_blocks + part][4 * (i % block)]);
    }
  }
  return colours;
}

}  // namespace

ReflectanceMap::ReflectanceMap(const Brdf& material, const LightSamples& light, int size) : image_(size, size, 3) {
  fill([&](const std::vector<Eigen::Vector3f>& normals) {
    if (const auto* ready = dynamic_cast<const TabulatedMaterial*>(&material))
      return table_colours(ready->table(), light, normals);
    if (const auto* dsbrdf = dynamic_cast<const Dsbrdf*>(&material))
      return table_colours(HalfwayTable(*dsbrdf), light, normals);
    return LightSum(material, light).colours(normals);
  });
}

ReflectanceMap::ReflectanceMap(const PatchSum& sum, int size) : image_(size, size, 3) {
  fill([&](const std::vector<Eigen::Vector3f>& normals) { return sum.colours(normals); });
}

template <typename Colours>
void ReflectanceMap::fill(const Colours& colours_of) {
  PARTWISE_CHECK(image_.width, >=, 8);
  const DiskTexels texels = disk_texels(image_.width);
  std::vector<Eigen::Vector3f> normals(texels.normals.size());
  std::ranges::transform(texels.normals, normals.begin(),
                         [](const auto& normal) { return normal.template cast<float>(); });
  normals_ = static_cast<int>(normals.size());
  const std::vector<Eigen::Vector3f> colours = colours_of(normals);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    std::copy_n(colours[i].data(), 3, image_.values.data() + 3 * static_cast<std::size_t>(texels.index[i]));
  }
}

Eigen::Vector3f ReflectanceMap::colour(const Eigen::Vector3f& normal) const {
  const DiskPlace<float> at(disk_point<float>(normal), image_.width);
  const std::array<float, 4> in_row = cubic_weights(at.right), in_column = cubic_weights(at.below);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int j = 0; j < 4; ++j) {
    Eigen::Vector3f row = Eigen::Vector3f::Zero();
    for (int i = 0; i < 4; ++i) {
      row += in_row[static_cast<std::size_t>(i)] *
             Eigen::Map<const Eigen::Vector3f>(image_.pixel(at.x + i - 1, at.y + j - 1));
    }
    sum += in_column[static_cast<std::size_t>(j)] * row;
  }
  return sum.cwiseMax(0.0f);
}

}  // namespace partwise
