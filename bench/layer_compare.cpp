// layer_compare: the rendering layer in its two forms beside the same sum in plain tensors with autograd. One JSON
// object on standard output.
//
// `seconds` are CPU seconds, as the kernel counts them, of one forward and one backward pass of one image, to normals,
// material and light, on --threads threads: of several repetitions the fewest. The plain form goes through the
// foreground in chunks, for all at once do not fit into memory; of the chunk sizes the cheapest counts. `errors`, one a
// light and material: mean absolute differences over mean values between mapped and exact images, and between their
// gradients (norm of the difference over the norm) for the loss sum of image times a fixed pattern.
#include <ATen/Parallel.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/learning/rendering_layer.h"
#include "partwise/learning/test_plain_rendering.h"

namespace {

using namespace partwise;

struct Options {
  std::string mesh;
  std::vector<std::string> lights, materials;
  std::vector<int> map_sizes{32, 64}, chunks{16, 64, 256};
  int size = 128, height = 64, repeat = 3, threads = 1;
  bool plain = false;
};

struct Inputs {
  at::Tensor normals, material, light;

  void clear() const {
    for (const at::Tensor& each : {normals, material, light}) each.mutable_grad() = at::Tensor();
  }
  std::vector<at::Tensor> gradients() const { return {normals.grad(), material.grad(), light.grad()}; }
};

// 1 x 3 x height x width, from interleaved values.
at::Tensor planes(const float* values, int height, int width) {
  const at::Tensor interleaved = torch::from_blob(const_cast<float*>(values), {1, height, width, 3}, torch::kFloat);
  return interleaved.permute({0, 3, 1, 2}).contiguous().clone();
}

at::Tensor normals_of(const Options& options) {
  const RenderMesh mesh{read_mesh(options.mesh)};
  const RenderScene scene({&mesh, 1});
  const Image image = scene.view(frame_share(scene, {}, 1), {options.size, options.size, 1}).normal_image();
  return planes(image.values.data(), options.size, options.size);
}

Inputs inputs_of(const at::Tensor& normals, const std::string& light_name, const std::string& material_name,
                 const Options& options) {
  const EnvironmentLight light = shipped_light(light_name).resized(2 * options.height, options.height);
  const DsbrdfCoefficients coefficients = shipped_material(material_name).brdf.coefficients();
  const at::Tensor material =
      torch::from_blob(const_cast<double*>(coefficients.data()), {1, dsbrdf_size}, torch::kDouble).to(torch::kFloat);
  return {normals.clone().requires_grad_(), material.clone().requires_grad_(),
          planes(light.radiance().values.data(), light.height(), light.width()).requires_grad_()};
}

at::Tensor pattern(const at::Tensor& images) {
  return torch::linspace(0, 50, images.numel(), torch::kFloat).sin().view_as(images) + 0.5;
}

double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Seconds {
  double forward = std::numeric_limits<double>::max(), backward = forward;

  double both() const { return forward + backward; }
  nlohmann::ordered_json json() const { return {{"forward", forward}, {"backward", backward}, {"both", both()}}; }
};

// `render` gives images; their loss is taken back.
template <typename Render>
Seconds time_layer(const Inputs& inputs, int repeat, const Render& render) {
  Seconds best;
  for (int i = 0; i < repeat; ++i) {
    inputs.clear();
    const double start = cpu_seconds();
    const at::Tensor images = render(inputs);
    Seconds now{cpu_seconds() - start, 0};
    const at::Tensor loss = (images * pattern(images)).sum();
    const double turn = cpu_seconds();
    loss.backward();
    now.backward = cpu_seconds() - turn;
    if (now.both() < best.both()) best = now;
  }
  return best;
}

Seconds time_plain(const Inputs& inputs, const test::PlainRendering& plain, std::int64_t chunk) {
  inputs.clear();
  const at::Tensor rows = inputs.normals[0].reshape({3, -1}).t(),
                   factors = pattern(inputs.normals)[0].reshape({3, -1}).t();
  const at::Tensor seen = (rows.detach().abs().sum(1) > 0).nonzero().squeeze(1);
  Seconds total{0, 0};
  for (std::int64_t first = 0; first < seen.numel(); first += chunk) {
    const at::Tensor some = seen.narrow(0, first, std::min(chunk, seen.numel() - first));
    const double start = cpu_seconds();
    const at::Tensor colours = plain.colours(rows.index_select(0, some), inputs.material[0], inputs.light[0]);
    const double turn = cpu_seconds();
    (colours * factors.index_select(0, some)).sum().backward({}, true);
    total.forward += turn - start;
    total.backward += cpu_seconds() - turn;
  }
  return total;
}

// Gradients to unit normals without their part along the normal, which means nothing: the forms differ in it.
std::vector<at::Tensor> across(std::vector<at::Tensor> gradients, const at::Tensor& normals) {
  const at::Tensor n = normals.detach();
  gradients[0] = gradients[0] - (gradients[0] * n).sum(1, true) * n;
  return gradients;
}

double relative(const at::Tensor& a, const at::Tensor& b) { return ((a - b).norm() / b.norm()).item<double>(); }

nlohmann::ordered_json times(const Inputs& inputs, const Options& options) {
  nlohmann::ordered_json result;
  result["exact"] = time_layer(inputs, options.repeat, [](const Inputs& in) {
                      return exact_images(in.normals, in.material, in.light);
                    }).json();
  const std::vector<at::Tensor> exact = inputs.gradients();
  for (const int size : options.map_sizes) {
    result["map " + std::to_string(size)] = time_layer(inputs, options.repeat, [&](const Inputs& in) {
                                              return mapped_images(in.normals, in.material, in.light, size);
                                            }).json();
  }
  if (!options.plain) return result;
  const test::PlainRendering plain(options.height, 2 * options.height, torch::kFloat);
  Seconds best;
  for (const int chunk : options.chunks) {
    const Seconds now = time_plain(inputs, plain, chunk);
    result["plain chunks"][std::to_string(chunk)] = now.both();
    if (now.both() < best.both()) best = now;
  }
  result["plain"] = best.json();
  const std::vector<at::Tensor> expected = inputs.gradients();
  const char* const names[] = {"normals", "material", "light"};
  for (std::size_t k = 0; k < 3; ++k) {  // the same work was done
    result["gradient_difference"][names[k]] = relative(exact[k], expected[k]);
  }
  return result;
}

nlohmann::ordered_json errors(const Inputs& inputs, const Options& options) {
  const auto render = [&](const auto& layer) {
    inputs.clear();
    const at::Tensor images = layer(inputs.normals, inputs.material, inputs.light);
    (images * pattern(images)).sum().backward();
    return std::pair(images.detach(), across(inputs.gradients(), inputs.normals));
  };
  const auto [exact, gradients] = render(exact_images);
  nlohmann::ordered_json result;
  for (const int size : options.map_sizes) {
    const auto [mapped, through_map] =
        render([&](const auto& n, const auto& m, const auto& l) { return mapped_images(n, m, l, size); });
    result[std::to_string(size)] = {{"image", ((mapped - exact).abs().sum() / exact.sum()).template item<double>()},
                                    {"of_normals", relative(through_map[0], gradients[0])},
                                    {"of_material", relative(through_map[1], gradients[1])},
                                    {"of_light", relative(through_map[2], gradients[2])}};
  }
  return result;
}

int run(const Options& options) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(options.threads));
  at::set_num_threads(options.threads);
  const at::Tensor normals = normals_of(options);
  nlohmann::ordered_json result{{"pixels", (normals[0].abs().sum(0) > 0).sum().item<std::int64_t>()}};
  result["seconds"] = times(inputs_of(normals, options.lights.front(), options.materials.front(), options), options);
  for (const std::string& light : options.lights) {
    for (const std::string& material : options.materials) {
      nlohmann::ordered_json entry{{"light", light}, {"material", material}};
      entry["maps"] = errors(inputs_of(normals, light, material, options), options);
      result["errors"].push_back(entry);
    }
  }
  std::cout << result.dump() << std::endl;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the rendering layer against plain tensors, and its two forms against each other.");
  Options options;
  app.add_option("MESH", options.mesh)->required();
  app.add_option("--lights", options.lights, "Names of shipped lights; times are under the first")->required();
  app.add_option("--materials", options.materials, "Names of shipped materials; times are of the first")->required();
  app.add_option("--size", options.size, "Pixels along a side")->check(CLI::PositiveNumber);
  app.add_option("--height", options.height, "Rows of the light")->check(CLI::PositiveNumber);
  app.add_option("--map-sizes", options.map_sizes, "Texels along a side of maps")->check(CLI::Range(8, 4096));
  app.add_option("--chunks", options.chunks, "Pixels that plain tensors take at a time")->check(CLI::PositiveNumber);
  app.add_option("--repeat", options.repeat, "Repetitions of the layer's passes")->check(CLI::PositiveNumber);
  app.add_option("--threads", options.threads, "Of the layer and of plain tensors")->check(CLI::PositiveNumber);
  app.add_flag("--plain", options.plain, "Time plain tensors too");
  return bench::run_tool("layer_compare", app, argc, argv, [&] { return run(options); });
}
