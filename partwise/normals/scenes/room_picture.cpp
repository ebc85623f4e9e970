#include "partwise/normals/scenes/room_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "partwise/appearance/rendering/part_colours.h"
#include "partwise/base/error.h"
#include "partwise/normals/truth/depth_normals.h"

namespace partwise {

double mirror_share(const DsbrdfCoefficients& material) {
  constexpr double dull = 2, mirror = 1000, most = 0.9;
  const DsbrdfLobes lobes = Dsbrdf(material).lobes(0);
  const double peak = lobes.value(1).maxCoeff(), beside = lobes.value(std::cos(std::numbers::pi / 4)).maxCoeff();
  const double steps = std::log(peak / std::max(beside, 1e-9) / dull) / std::log(mirror / dull);
  return most * std::clamp(steps, 0.0, 1.0);
}

RoomPicture room_picture(const Room& room, std::span<const DsbrdfCoefficients> materials, const EnvironmentLight& light,
                         const RoomPictureSettings& settings) {
  PARTWISE_CHECK(std::ssize(materials), ==, room.parts);
  std::vector<std::shared_ptr<const Brdf>> worn;
  for (const DsbrdfCoefficients& each : materials) worn.push_back(std::make_shared<Dsbrdf>(each));
  const RenderScene scene(room.meshes);
  const GBuffer seen = scene.view(room.camera, settings.size);
  // Means of samples would lie on neither surface where two meet: the truth is what the pixel's middle sees.
  const GBuffer middle = scene.view(room.camera, {settings.size.width, settings.size.height, 1});
  const LightSamples samples = light_samples(light, room.camera.axes);

  RoomPicture picture;
  picture.image = PartColours(worn, samples, RenderPath::reflectance_map, settings.map_size).image(seen);
  picture.normals = middle.normal_image();
  picture.depth = middle.depth_image();
  picture.parts = middle.part_of_pixels();

  std::vector<float> losses;
  for (const DsbrdfCoefficients& each : materials) losses.push_back(static_cast<float>(mirror_share(each)));
  Image mirrors(settings.size.width, settings.size.height, 1);
  std::ranges::transform(picture.parts, mirrors.values.begin(),
                         [&](int part) { return part < 0 ? 0 : losses[static_cast<std::size_t>(part)]; });
  const PinholeCamera camera = pinhole_camera(room.camera, settings.size.width, settings.size.height);
  picture.sensed = sensed_depth(picture.depth, picture.normals, mirrors, camera, settings.sensor, settings.seed);
  picture.noisy_normals = normals_from_depth(picture.sensed, camera);
  return picture;
}

}  // namespace partwise
