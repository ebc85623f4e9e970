#include "views.h"

#include <algorithm>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/palette.h"
#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/imaging/tone_mapping.h"

namespace demo {
namespace {

using namespace partwise;

template <typename Colour>
Image channel_image(const GBuffer& seen, const Colour& colour) {
  return masked(seen.mask_image(), colour);
}

}  // namespace

EnvironmentLight resized_light(const std::string& name, int rows) {
  return shipped_light(name).resized(2 * rows, rows);
}

std::vector<Dsbrdf> brdfs_of(const std::vector<std::string>& names) {
  std::vector<Dsbrdf> result;
  result.reserve(names.size());
  for (const std::string& name : names) result.push_back(shipped_material(name).brdf);
  return result;
}

Image from_codes(Image codes) {
  for (std::size_t i = 0; i < codes.values.size(); ++i) {
    if (codes.channels != 4 || i % 4 != 3) codes.values[i] = linear_from_srgb(codes.values[i]);
  }
  return codes;
}

Image for_the_eye(const Image& linear, float exposure) {
  Image mapped = tone_map(linear, exposure);
  for (float& value : mapped.values) value /= 255;
  return from_codes(std::move(mapped));
}

Image normals_of(const GBuffer& seen) {
  const Image normals = seen.normal_image();
  return from_codes(channel_image(seen, [&](std::size_t i) -> Eigen::Vector3f {
    return (Eigen::Map<const Eigen::Vector3f>(&normals.values[3 * i]).array() + 1) / 2;
  }));
}

Image depth_of(const GBuffer& seen) {
  const Image depth = seen.depth_image();
  float near = 1e30f, far = 0;
  for (const float each : depth.values) {
    if (each > 0) near = std::min(near, each), far = std::max(far, each);
  }
  return from_codes(channel_image(seen, [&](std::size_t i) -> Eigen::Vector3f {
    return Eigen::Vector3f::Constant(0.95f - 0.75f * (depth.values[i] - near) / std::max(far - near, 1e-6f));
  }));
}

Image parts_of(const GBuffer& seen) {
  const std::vector<int> parts = seen.part_of_pixels();
  return channel_image(seen, [&](std::size_t i) -> Eigen::Vector3f { return part_colour(std::max(parts[i], 0)); });
}

Image mask_of(const GBuffer& seen) {
  return channel_image(seen, [&](std::size_t) -> Eigen::Vector3f { return Eigen::Vector3f::Constant(0.55f); });
}

Image worn_image(const GBuffer& seen, const std::vector<Dsbrdf>& materials, const EnvironmentLight& light, bool fine) {
  std::vector<ReflectanceMap> maps;
  std::vector<const ReflectanceMap*> worn;
  const LightTree tree(light);
  const LightSamples samples = light_samples(light);
  maps.reserve(materials.size());
  worn.reserve(materials.size());
  for (const Dsbrdf& material : materials)
    maps.push_back(fine ? ReflectanceMap(PatchSum(material, tree), 96) : ReflectanceMap(material, samples, 48));
  for (const ReflectanceMap& map : maps) worn.push_back(&map);
  return mapped_image(seen, worn);
}

Image worn_picture(const GBuffer& seen, const std::vector<Dsbrdf>& materials, const EnvironmentLight& light,
                   bool fine) {
  const Image image = worn_image(seen, materials, light, fine);
  return for_the_eye(on_clear_ground(image, seen.mask_image()), grey_card_exposure(light));
}

GBuffer view_of(const WornModel& model, double azimuth, int size, double share) {
  const RenderMesh mesh{model.mesh, model.parts};
  const RenderScene scene({&mesh, 1});
  return scene.view(frame_share(scene, {.azimuth = azimuth, .share = share}, 1), {size, size, 8});
}

}  // namespace demo
