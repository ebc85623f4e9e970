// How well networks edit: the figures of the dissertation's Tables 3.1 and 3.2 on views that they have not seen.
//
//   editing_errors WEIGHTS VIEWS... [--count 500] [--first 0] [--given | --known-normals] [--parts]
//                  [--refine] [--spread] [--materials test] [--lights NAME...] [--seed S]
//
// A line of JSON a picture: "material", the squared difference of scaled coefficients, summed over the 108; "render",
// the picture rendered anew; "transfer", the object in another material. With --refine "refined_render" and
// "refined_transfer" as well. Each of them is {"l2", "ssim", "l2_frame", "ssim_frame"} of tone-mapped images, over the
// object and over the frame, each image exposed by its own object's median; under "same_exposure" both by the true one.
//   --given          true normals and light with the predicted material (Table 3.1)
//   --known-normals  true normals; light and material are optimised from what is likely before one looks, as Lombardi
//                    and Nishino do (Table 3.2): of the weights only the range of materials counts
//   --parts          each part of a view in a material of its own
//   --spread         "normal_deviations" and "light_deviations", what networks get wrong by levels of 1, 2, 4, ... rows
// Exits 0, 1 when it cannot be done, 2 for wrong usage.
#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/edit_cases.h"
#include "bench/picture_difference.h"
#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/encoder_decoder.h"
#include "partwise/editing/error_levels.h"
#include "partwise/editing/refinement.h"

namespace {

using namespace partwise;
using bench::difference, bench::EditCase;
using nlohmann::ordered_json;

struct Options {
  std::string weights, materials = "test";
  bench::JudgedPictures pictures;
  bool given = false, known_normals = false, refine = false, spread = false;
  int first = 0;
  RefinementSettings refinement;
};

// Mean over the regions.
double material_error(const at::Tensor& scaled, const EditCase& truth, const MaterialRange& range) {
  return (scaled - range.scaled(truth.materials)).square().sum(1).mean().item<double>();
}

ordered_json redrawn(const EncoderDecoder& network, const EditCase& truth) {
  const MaterialRange range = network.range();
  const Redrawn found = network(truth.picture, range.scaled(truth.targets));
  constexpr double gamma = 2.2;
  return {{"material", material_error(found.material, truth, range)},
          {"transfer", difference(found.image.pow(gamma), truth.target, truth.mask())}};
}

class Reader {
 public:
  Reader(EditingNetworks networks, const Options& options)
      : networks_(std::move(networks)), range_(networks_.range()), options_(options) {}

  ordered_json operator()(const EditCase& truth) const {
    ordered_json json;
    if (options_.known_normals) {
      add(json, "", optimised(truth), truth);
    } else if (options_.given) {
      const PictureLayers found{truth.normals, material(truth), log_of_radiance(truth.radiance)};
      json["material"] = material_error(found.material, truth, range_);
      json["render"] = difference(shown(found, range_.coefficients(found.material), truth), truth.image, truth.mask());
    } else {
      const PictureLayers found{networks_.normals(truth.picture), material(truth),
                                networks_.log_radiance(truth.picture)};
      json["material"] = material_error(found.material, truth, range_);
      add(json, "", found, truth);
      if (options_.spread) add_spread(json, found, truth);
      if (options_.refine)
        add(json, "refined_", refined(found, range_, truth.picture, truth.regions, options_.refinement).found, truth);
    }
    return json;
  }

 private:
  // Of each region, seen alone.
  at::Tensor material(const EditCase& truth) const {
    std::vector<at::Tensor> rows;
    for (const at::Tensor& region : truth.regions) rows.push_back(networks_.scaled_material(truth.picture * region));
    return at::cat(rows);
  }

  // What Lombardi and Nishino know before they look: here the mean of the training materials, and light from
  // everywhere; refined from there for longer than what networks find.
  PictureLayers optimised(const EditCase& truth) const {
    const auto regions = static_cast<std::int64_t>(truth.regions.size());
    std::vector<at::Tensor> materials;
    for (const std::string& each : training_materials())
      materials.push_back(range_.scaled(as_tensor(shipped_material(each).brdf.coefficients()).unsqueeze(0)));
    const PictureLayers start{truth.normals, at::cat(materials).mean(0, true).expand({regions, -1}).contiguous(),
                              log_of_radiance(at::ones_like(truth.radiance))};
    RefinementSettings settings;
    settings.normals_known = true;
    settings.rounds = 10;
    return refined(start, range_, truth.picture, truth.regions, settings).found;
  }

  at::Tensor shown(const PictureLayers& found, const at::Tensor& materials, const EditCase& truth) const {
    return bench::image_of_regions(found.normals, truth.regions, materials, radiance_of_log(found.log_radiance),
                                   options_.pictures.cases.map_size);
  }

  void add(ordered_json& json, const std::string& name, const PictureLayers& found, const EditCase& truth) const {
    const at::Tensor mask = truth.mask();
    json[name + "render"] = difference(shown(found, range_.coefficients(found.material), truth), truth.image, mask);
    json[name + "transfer"] = difference(shown(found, truth.targets, truth), truth.target, mask);
    json[name + "cosine"] = ((found.normals * truth.normals).sum() / mask.sum()).item<double>();
  }

  static void add_spread(ordered_json& json, const PictureLayers& found, const EditCase& truth) {
    const at::Tensor mask = truth.mask();
    const at::Tensor light = log_of_radiance(truth.radiance) - found.log_radiance;
    json["normal_deviations"] = level_deviations((truth.normals - found.normals) * mask, mask);
    json["light_deviations"] = level_deviations(light, at::ones_like(light).narrow(1, 0, 1));
  }

  EditingNetworks networks_;
  MaterialRange range_;
  const Options& options_;
};

int judge(const Options& options) {
  const at::NoGradGuard no_gradient;
  std::optional<Reader> reader;
  std::optional<EncoderDecoder> peer;
  if (read_weights_header(options.weights).kind == "encoder_decoder") {
    peer = read_encoder_decoder(options.weights);
  } else {
    reader.emplace(read_editing_networks(options.weights), options);
  }
  const bench::JudgedPictures& pictures = options.pictures;
  const StoredViews views({pictures.views.begin(), pictures.views.end()});
  const auto names = options.materials == "test" ? test_materials() : training_materials();
  const bench::EditCases cases(views, names, pictures.lights, pictures.cases);
  for (int i = options.first; i < options.first + pictures.count; ++i) {
    const EditCase truth = cases(i);
    ordered_json json = {{"picture", i}, {"regions", truth.regions.size()}};
    json.update(peer ? redrawn(*peer, truth) : (*reader)(truth));
    std::cout << json.dump() << std::endl;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("How well networks edit");
  app.add_option("weights", options.weights, "of networks of editing")->required();
  bench::add_options(app, options.pictures);
  app.add_option("--materials", options.materials)->check(CLI::IsMember({"test", "training"}));
  app.add_option("--first", options.first, "number of the first picture")->check(CLI::NonNegativeNumber);
  CLI::Option* given = app.add_flag("--given", options.given, "true normals and light");
  app.add_flag("--known-normals", options.known_normals, "true normals, the rest optimised")->excludes(given);
  app.add_flag("--spread", options.spread, "of what networks get wrong, by levels");
  app.add_flag("--refine", options.refine, "after refinement as well");
  app.add_option("--normal-weight", options.refinement.normal_weight, "a of (3.6)")->check(CLI::NonNegativeNumber);
  app.add_option("--light-weight", options.refinement.light_weight, "b of (3.6)")->check(CLI::NonNegativeNumber);
  app.add_option("--material-weight", options.refinement.material_weight, "c")->check(CLI::NonNegativeNumber);
  app.add_option("--rounds", options.refinement.rounds, "of refinement")->check(CLI::PositiveNumber);
  app.add_option("--steps", options.refinement.steps, "of each minimisation")->check(CLI::PositiveNumber);
  return bench::run_tool("editing_errors", app, argc, argv, [&] { return judge(options); });
}
