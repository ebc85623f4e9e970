// render_error: the two ways to render, beside each other, on one scene and several lights and materials. One JSON
// object a pair of light and material, on standard output.
//
// Errors are mean absolute differences over mean values, of linear images over the foreground, one sample a pixel:
// `map` of the reflectance map from the exact sum, both under a light of --height rows; and of both from the exact sum
// under the finer light of --reference rows, `map_reference` and `exact_reference`. Seconds are those of the sum or map
// alone, on all threads; pairs are normals times light samples.
#include <CLI/CLI.hpp>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/imaging/image_metrics.h"

namespace {

using namespace partwise;

struct Options {
  std::string mesh;
  std::vector<std::string> lights, materials;
  int size = 128, height = 64, map_size = 64, reference = 256;
};

template <typename Work>
auto timed(const Work& work, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  auto result = work();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Image exact(const GBuffer& seen, const Brdf& material, const LightSamples& light) {
  const LightSum sum(material, light);
  const std::array sums{&sum};
  return exact_image(seen, sums);
}

nlohmann::ordered_json compare(const GBuffer& seen, const std::string& light_name, const std::string& material_name,
                               const Options& options) {
  const EnvironmentLight light = shipped_light(light_name);
  const Dsbrdf material = shipped_material(material_name).brdf;
  const LightSamples coarse = light_samples(light.resized(2 * options.height, options.height));
  const LightSamples fine = light_samples(light.resized(2 * options.reference, options.reference));
  double exact_seconds = 0, map_seconds = 0;
  const Image truth = timed([&] { return exact(seen, material, coarse); }, exact_seconds);
  std::optional<ReflectanceMap> map;
  const Image mapped = timed(
      [&] {
        map.emplace(material, coarse, options.map_size);
        const std::array maps{&*map};
        return mapped_image(seen, maps);
      },
      map_seconds);
  const Image reference = exact(seen, material, fine);
  const double pixels = seen.foreground() * static_cast<double>(seen.parts.size());
  const auto samples = static_cast<double>(coarse.size());
  return {{"light", light_name},
          {"material", material_name},
          {"pixels", pixels},
          {"normals", map->normals()},
          {"light_samples", samples},
          {"map", relative_error(mapped, truth)},
          {"map_reference", relative_error(mapped, reference)},
          {"exact_reference", relative_error(truth, reference)},
          {"exact_seconds", exact_seconds},
          {"map_seconds", map_seconds},
          {"exact_ns_a_pair", 1e9 * exact_seconds / (pixels * samples)},
          {"map_ns_a_pair", 1e9 * map_seconds / (map->normals() * samples)}};
}

int run(const Options& options) {
  const RenderMesh mesh{read_mesh(options.mesh)};
  const RenderScene scene({&mesh, 1});
  const GBuffer seen = scene.view(frame_share(scene, {}, 1), {options.size, options.size, 1});
  for (const std::string& light : options.lights) {
    for (const std::string& material : options.materials) {
      std::cout << compare(seen, light, material, options).dump() << std::endl;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures reflectance maps against exact sums.");
  Options options;
  app.add_option("MESH", options.mesh)->required();
  app.add_option("--lights", options.lights, "Names of shipped lights")->required();
  app.add_option("--materials", options.materials, "Names of shipped materials")->required();
  app.add_option("--size", options.size, "Pixels along a side")->check(CLI::PositiveNumber);
  app.add_option("--height", options.height, "Rows of the light")->check(CLI::PositiveNumber);
  app.add_option("--map-size", options.map_size, "Texels along a side of the map")->check(CLI::Range(8, 4096));
  app.add_option("--reference", options.reference, "Rows of the finer light")->check(CLI::PositiveNumber);
  return bench::run_tool("render_error", app, argc, argv, [&] { return run(options); });
}
