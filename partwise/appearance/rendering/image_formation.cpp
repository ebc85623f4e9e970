#include "partwise/appearance/rendering/image_formation.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "partwise/base/error.h"

namespace partwise {
namespace {

Eigen::Vector3f towards_viewer(const Eigen::Vector3f& normal) {
  if (normal.z() >= 0) return normal;
  const float length = normal.head<2>().norm();
  return length > 0 ? Eigen::Vector3f(normal.x() / length, normal.y() / length, 0) : Eigen::Vector3f::UnitX();
}

// colour(sample, normal) of every sample that sees something, averaged over pixels.
template <typename Colour>
Image form_image(const GBuffer& seen, std::size_t materials, const Colour& colour) {
  PARTWISE_CHECK(*std::max_element(seen.parts.begin(), seen.parts.end()), <, static_cast<int>(materials));
  Image image(seen.size.width, seen.size.height, 3);
  const auto samples = static_cast<std::size_t>(seen.size.samples);
  constexpr std::size_t grain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, image.values.size() / 3, grain), [&](const auto& range) {
    for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
      Eigen::Vector3f sum = Eigen::Vector3f::Zero();
      for (std::size_t i = pixel * samples; i < (pixel + 1) * samples; ++i) {
        if (seen.parts[i] >= 0) sum += colour(i, towards_viewer(seen.normals[i]));
      }
      sum /= static_cast<float>(samples);
      std::copy_n(sum.data(), 3, &image.values[3 * pixel]);
    }
  });
  return image;
}

}  // namespace

Image exact_image(const GBuffer& seen, std::span<const LightSum* const> sums) {
  return form_image(seen, sums.size(), [&](std::size_t sample, const Eigen::Vector3f& normal) {
    return sums[static_cast<std::size_t>(seen.parts[sample])]->colour(normal);
  });
}

Image mapped_image(const GBuffer& seen, std::span<const ReflectanceMap* const> maps) {
  return form_image(seen, maps.size(), [&](std::size_t sample, const Eigen::Vector3f& normal) {
    return maps[static_cast<std::size_t>(seen.parts[sample])]->colour(normal);
  });
}

Image on_clear_ground(const Image& formed, const Image& mask) {
  Image image(formed.width, formed.height, 4);
  for (std::size_t pixel = 0; pixel < mask.values.size(); ++pixel) {
    const float covered = mask.values[pixel];
    float* out = &image.values[4 * pixel];
    out[3] = covered;
    for (std::size_t k = 0; covered > 0 && k < 3; ++k) out[k] = formed.values[3 * pixel + k] / covered;
  }
  return image;
}

Image shadowed_image(const GBuffer& seen, std::span<const LightSum* const> sums, const RenderScene& scene,
                     const Camera& camera, const LightSamples& light) {
  return form_image(seen, sums.size(), [&](std::size_t sample, const Eigen::Vector3f& normal) {
    Eigen::ArrayXf visible;
    scene.lit(camera, seen, sample, light, visible);
    return sums[static_cast<std::size_t>(seen.parts[sample])]->colour(normal, visible.data());
  });
}

}  // namespace partwise
