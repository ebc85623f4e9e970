// How well networks edit: the figures of the dissertation's Tables 3.1 and 3.2 on views that they have not seen.
//
//   editing_errors WEIGHTS VIEWS... [--count 500] [--given] [--refine] [--materials test] [--lights NAME...] [--seed S]
//
// A line of JSON a picture: "material", the squared difference of scaled coefficients, summed over the 108; "render",
// the picture rendered anew; "transfer", the object in another material. --given: true normals and light with the
// predicted material (Table 3.1); else all three are predicted (Table 3.2), and with --refine "refined_render" and
// "refined_transfer" as well. Each of them is {"l2", "ssim", "l2_frame", "ssim_frame"}: tone-mapped by the median of
// the true object, over the object and over the frame. Exits 0, 1 when it cannot be done, 2 for wrong usage.
#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <fmt/format.h>
#include <torch/types.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/editing/edit_samples.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/encoder_decoder.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/refinement.h"
#include "partwise/imaging/image_metrics.h"
#include "partwise/imaging/tone_mapping.h"
#include "partwise/learning/rendering_layer.h"

namespace {

using namespace partwise;

struct Options {
  std::string weights, materials = "test";
  std::vector<std::string> views, lights = {"lobby", "night", "sunrise", "venice"};
  int count = 500, map_size = 64;
  std::uint64_t seed = 1;
  bool given = false, refine = false;
};

nlohmann::ordered_json difference(const at::Tensor& image, const at::Tensor& truth, const at::Tensor& mask) {
  const Image object = image_of(mask[0]);
  const float exposure = exposure_by_median(image_of(truth[0]), object);
  const Image a = tone_map(image_of(image[0].clamp_min(0)), exposure), b = tone_map(image_of(truth[0]), exposure);
  const ImageDifference inside = compare_images(a, b, object), whole = compare_images(a, b);
  nlohmann::ordered_json json = {{"l2", inside.squared_error}};
  if (inside.ssim) json["ssim"] = *inside.ssim;
  json["l2_frame"] = whole.squared_error;
  json["ssim_frame"] = *whole.ssim;
  return json;
}

class Judge {
 public:
  explicit Judge(const Options& options)
      : options_(options),
        views_({options.views.begin(), options.views.end()}),
        samples_(views_, materials(), lights(),
                 {.seed = options.seed, .group = 2, .map_size = options.map_size, .varied = false}) {
    if (read_weights_header(options.weights).kind == "encoder_decoder") {
      peer_ = read_encoder_decoder(options.weights);
    } else {
      networks_ = read_editing_networks(options.weights);
    }
  }

  nlohmann::ordered_json picture(int number) const {
    const at::NoGradGuard no_gradient;
    const EditBatch batch = samples_.batch(static_cast<std::uint64_t>(number), {0, 1, 2});
    return peer_ ? redrawn(number, batch) : read(number, batch);
  }

 private:
  nlohmann::ordered_json redrawn(int number, const EditBatch& batch) const {
    const MaterialRange range = peer_->range();
    const Redrawn found = (*peer_)(batch.pictures, range.scaled(batch.target_material));
    constexpr double gamma = 2.2;
    return {{"picture", number},
            {"material", (found.material - range.scaled(batch.material)).square().sum().item<double>()},
            {"transfer", difference(found.image.pow(gamma), batch.target, batch.mask())}};
  }

  nlohmann::ordered_json read(int number, const EditBatch& batch) const {
    const MaterialRange range = networks_->range();
    PictureLayers found{batch.normals, networks_->scaled_material(batch.pictures), log_of_radiance(batch.radiance)};
    nlohmann::ordered_json json;
    json["picture"] = number;
    json["material"] = (found.material - range.scaled(batch.material)).square().sum().item<double>();
    if (options_.given) {
      json["render"] = difference(shown(batch.normals, range.coefficients(found.material), batch.radiance), batch.image,
                                  batch.mask());
      return json;
    }
    found = (*networks_)(batch.pictures);
    add(json, "", found, batch, range);
    if (!options_.refine) return json;
    add(json, "refined_", refined(found, range, batch.pictures, {batch.mask()}).found, batch, range);
    return json;
  }

  at::Tensor shown(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& radiance) const {
    return mapped_images(normals, material, radiance, options_.map_size);
  }

  void add(nlohmann::ordered_json& json, const std::string& name, const PictureLayers& found, const EditBatch& batch,
           const MaterialRange& range) const {
    const at::Tensor radiance = radiance_of_log(found.log_radiance);
    json[name + "render"] =
        difference(shown(found.normals, range.coefficients(found.material), radiance), batch.image, batch.mask());
    json[name + "transfer"] =
        difference(shown(found.normals, batch.target_material, radiance), batch.target, batch.mask());
    json[name + "cosine"] = ((found.normals * batch.normals).sum() / batch.mask().sum()).item<double>();
  }

  std::vector<DsbrdfCoefficients> materials() const {
    std::vector<DsbrdfCoefficients> result;
    for (const std::string& name : options_.materials == "test" ? test_materials() : training_materials())
      result.push_back(shipped_material(name).brdf.coefficients());
    return result;
  }
  std::vector<EnvironmentLight> lights() const {
    std::vector<EnvironmentLight> result;
    for (const std::string& name : options_.lights) result.push_back(named_light(name));
    return result;
  }

  const Options& options_;
  std::optional<EditingNetworks> networks_;
  std::optional<EncoderDecoder> peer_;
  StoredViews views_;
  EditSamples samples_;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("How well networks edit");
  app.add_option("weights", options.weights, "of networks of editing")->required();
  app.add_option("views", options.views, "folders of shards")->required();
  app.add_option("--count", options.count, "pictures")->check(CLI::PositiveNumber);
  app.add_option("--map-size", options.map_size, "of reflectance maps")->check(CLI::Range(8, 512));
  app.add_option("--materials", options.materials)->check(CLI::IsMember({"test", "training"}));
  app.add_option("--lights", options.lights, "that pictures are lit by");
  app.add_option("--seed", options.seed);
  app.add_flag("--given", options.given, "true normals and light");
  app.add_flag("--refine", options.refine, "after refinement as well");
  return bench::run_tool("editing_errors", app, argc, argv, [&] {
    const Judge judge(options);
    for (int i = 0; i < options.count; ++i) std::cout << judge.picture(i).dump() << std::endl;
    return 0;
  });
}
