#include "partwise/editing/edit_photo.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "partwise/appearance/rendering/light_tree.h"
#include "partwise/appearance/rendering/reflectance_map.h"
#include "partwise/base/error.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/picture_terms.h"

namespace partwise {
namespace {

constexpr int map_size = 128;
constexpr int fine = 4;  // pixels along a side of one of the light's: mirrors have lobes narrower than those

// display_values from a table: one tensor for each of a million pixels would take minutes.
class DisplayCurve {
 public:
  DisplayCurve() : values_(display_values(at::linspace(0, 1, steps + 1).square()).contiguous()) {}
  float operator()(float linear) const {
    const float place = std::sqrt(std::clamp(linear, 0.0f, 1.0f)) * steps;
    const int i = std::min(static_cast<int>(place), steps - 1);
    const float* table = values_.data_ptr<float>();
    return table[i] + (place - static_cast<float>(i)) * (table[i + 1] - table[i]);
  }

 private:
  static constexpr int steps = 4096;  // of the root, so that dark values have more
  at::Tensor values_;
};

}  // namespace

PhotoLayers read_layers(const EditingNetworks& networks, const Photo& photo, const ReadingSettings& settings,
                        const Progress& progress) {
  const at::NoGradGuard no_gradient;
  const std::int64_t size = networks.settings().size;
  PhotoLayers layers;
  layers.crop = crop_of(photo);
  const auto square = [&](const Image& image) {
    return cropped(image, layers.crop.x, layers.crop.y, layers.crop.side);
  };
  at::Tensor mask = at::zeros({1, 1, size, size});
  for (const Image& region : photo.regions) {
    layers.regions.push_back((resized(square(region), size) > 0.5).to(at::kFloat));
    mask = at::maximum(mask, layers.regions.back());
  }
  const at::Tensor colours = resized(square(photo.shown), size);
  layers.picture = at::cat({colours * mask, mask}, 1);
  progress("look", 0);
  layers.found.normals = networks.normals(layers.picture);
  layers.found.log_radiance = networks.log_radiance(layers.picture);
  std::vector<at::Tensor> materials;
  for (const at::Tensor& region : layers.regions) {
    materials.push_back(networks.scaled_material(at::cat({colours * region, region}, 1)));
  }
  layers.found.material = at::cat(materials);
  RefinementSettings refinement = settings.refinement;
  if (!settings.refine) refinement.rounds = 0;
  const Refinement result =
      refined(layers.found, networks.range(), layers.picture, layers.regions, refinement, progress);
  layers.found = result.found;
  layers.error_before = result.before;
  layers.error = result.after;
  return layers;
}

EnvironmentLight light_of(const PhotoLayers& layers) {
  return EnvironmentLight(image_of(radiance_of_log(layers.found.log_radiance)[0]));
}

Image edited(const Photo& photo, const PhotoLayers& layers, const std::vector<DsbrdfCoefficients>& materials,
             const std::optional<EnvironmentLight>& light) {
  PARTWISE_CHECK(materials.size(), ==, photo.regions.size());
  const Crop& crop = layers.crop;
  // Beyond the object there are no normals: what enlarging mixes in from there is of length zero and drops out.
  const at::Tensor normals = resized(layers.found.normals, crop.side).contiguous();
  const std::int64_t plane = std::int64_t{crop.side} * crop.side;
  const float* n = normals.data_ptr<float>();
  const LightTree tree((light ? *light : light_of(layers)).resized(fine * light_columns, fine * light_rows));
  const DisplayCurve curve;
  Image result(photo.shown.width, photo.shown.height, photo.has_alpha ? 4 : 3);
  for (std::size_t i = 0; i < photo.alpha.values.size(); ++i) {
    const auto channels = static_cast<std::size_t>(result.channels);
    std::copy_n(&photo.shown.values[3 * i], 3, &result.values[channels * i]);
    if (channels == 4) result.values[4 * i + 3] = photo.alpha.values[i];
  }
  for (std::size_t region = 0; region < materials.size(); ++region) {
    const Dsbrdf material(materials[region]);
    const ReflectanceMap map(PatchSum(material, tree), map_size);
    const Image& mask = photo.regions[region];
    tbb::parallel_for(std::max(0, -crop.y), std::min(crop.side, mask.height - crop.y), [&](int y) {
      for (int x = std::max(0, -crop.x); x < std::min(crop.side, mask.width - crop.x); ++x) {
        const float share = *mask.pixel(x + crop.x, y + crop.y);
        const std::int64_t at = std::int64_t{y} * crop.side + x;
        const Eigen::Vector3f normal(n[at], n[plane + at], n[2 * plane + at]);
        if (share <= 0 || normal.squaredNorm() < 1e-6f) continue;
        const Eigen::Vector3f colour = map.colour(normal.normalized());
        float* out = result.pixel(x + crop.x, y + crop.y);
        for (int c = 0; c < 3; ++c) out[c] += share * (curve(colour[c]) - out[c]);
      }
    });
  }
  return result;
}

}  // namespace partwise
