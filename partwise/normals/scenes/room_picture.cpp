#include "partwise/normals/scenes/room_picture.h"

#include <algorithm>
#include <memory>

#include "partwise/appearance/rendering/part_colours.h"
#include "partwise/base/error.h"
#include "partwise/normals/truth/depth_normals.h"

namespace partwise {
namespace {

// Materials in place of parts.
GBuffer worn(GBuffer seen, const Camera& camera, const RoomWear& wear) {
  for (std::size_t i = 0; i < seen.parts.size(); ++i) {
    if (seen.parts[i] < 0) continue;
    const PartWear& part = wear.parts[static_cast<std::size_t>(seen.parts[i])];
    seen.parts[i] = part.material(seen_point(seen, camera, i));
  }
  return seen;
}

}  // namespace

RoomPicture room_picture(const Room& room, const RoomWear& wear, const EnvironmentLight& light,
                         const RoomPictureSettings& settings) {
  PARTWISE_CHECK(std::ssize(wear.parts), ==, room.parts);
  std::vector<std::shared_ptr<const Brdf>> materials;
  std::vector<float> losses;
  for (const DsbrdfCoefficients& each : wear.materials) {
    materials.push_back(std::make_shared<Dsbrdf>(each));
    losses.push_back(static_cast<float>(mirror_share(each)));
  }
  const RenderScene scene(room.meshes);
  const GBuffer seen = worn(scene.view(room.camera, settings.size), room.camera, wear);
  // Means of samples would lie on neither surface where two meet: the truth is what the pixel's middle sees.
  const RasterSize middles{settings.size.width, settings.size.height, 1};
  const GBuffer middle = worn(scene.view(room.camera, middles), room.camera, wear);
  const LightSamples samples = light_samples(light, room.camera.axes);

  RoomPicture picture;
  picture.image = PartColours(materials, samples, RenderPath::reflectance_map, settings.map_size).image(seen);
  picture.normals = middle.normal_image();
  picture.depth = middle.depth_image();
  picture.materials = middle.part_of_pixels();

  Image mirrors(settings.size.width, settings.size.height, 1);
  std::ranges::transform(picture.materials, mirrors.values.begin(), [&](int material) {
    return material < 0 ? 0 : losses[static_cast<std::size_t>(material)];
  });
  const PinholeCamera camera = pinhole_camera(room.camera, settings.size.width, settings.size.height);
  picture.sensed = sensed_depth(picture.depth, picture.normals, mirrors, camera, settings.sensor, settings.seed);
  picture.noisy_normals = normals_from_depth(picture.sensed, camera);
  return picture;
}

}  // namespace partwise
