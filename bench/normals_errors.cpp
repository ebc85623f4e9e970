// How well networks read normals off pictures: views that no training has seen in materials and light that none has
// seen, as bench/edit_cases.h makes them.
//
//   normals_errors VIEWS... --weights F.pt... [--count 500] [--parts]
//
// One JSON line a network: "weights", "pictures"; "all", "edges", "curved" and "smooth", the figures of
// normals/truth/normal_measures.h where normal_detail.h says, with the pixels of all pictures pooled; "cosine", the
// mean over pictures of each one's mean; and of the picture rendered with the normals that were found and the true
// material and light "l2", "ssim", "l2_frame" and "ssim_frame", exposed as the true one, means over pictures.
#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <CLI/CLI.hpp>

#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/edit_cases.h"
#include "bench/normal_figures.h"
#include "bench/picture_difference.h"
#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/normals/prediction/normal_predictor.h"
#include "partwise/normals/truth/normal_detail.h"

namespace {

using namespace partwise;
using nlohmann::ordered_json;

struct Options {
  std::vector<std::string> weights;
  bench::JudgedPictures pictures;
};

// One network's figures so far.
class Judge {
 public:
  explicit Judge(const std::string& weights) : weights_(weights), predictor_(read_normal_predictor(weights)) {}

  void look(const bench::EditCase& truth, int map_size) {
    const at::Tensor normals = predictor_.both_ways(truth.picture), mask = truth.mask();
    detail_.add(image_of(normals[0]), image_of(truth.normals[0]));
    add("cosine", ((normals * truth.normals).sum() / mask.sum()).item<double>());
    const at::Tensor image = bench::image_of_maps(normals, truth.regions, truth.maps, map_size);
    const ordered_json errors = bench::difference(image, truth.image, mask).at("same_exposure");
    for (const auto& [name, value] : errors.items()) add(name, value.get<double>());
  }

  ordered_json figures(int pictures) const {
    ordered_json json = {{"weights", weights_}, {"pictures", pictures}};
    for (const auto& [name, of] : {std::pair{"all", &detail_.all},
                                   {"edges", &detail_.edges},
                                   {"curved", &detail_.curved},
                                   {"smooth", &detail_.smooth}})
      json[name] = bench::normal_figures(*of);
    for (const auto& [name, mean] : means_) json[name] = mean.sum / mean.count;
    return json;
  }

 private:
  struct Mean {
    double sum = 0;
    int count = 0;
  };
  void add(const std::string& name, double value) {
    means_[name].sum += value;
    ++means_[name].count;
  }

  std::string weights_;
  NormalPredictor predictor_;
  DetailMeasure detail_;
  std::map<std::string, Mean> means_;
};

int judge(const Options& options) {
  const at::NoGradGuard no_gradient;
  std::vector<Judge> judges(options.weights.begin(), options.weights.end());
  const bench::JudgedPictures& pictures = options.pictures;
  const StoredViews views({pictures.views.begin(), pictures.views.end()});
  const bench::EditCases cases(views, test_materials(), pictures.lights, pictures.cases);
  for (int i = 0; i < pictures.count; ++i) {
    const bench::EditCase truth = cases(i);
    for (Judge& each : judges) each.look(truth, pictures.cases.map_size);
  }
  for (const Judge& each : judges) std::cout << each.figures(pictures.count).dump() << std::endl;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.pictures.cases.targets = false;
  CLI::App app("How well networks read normals off pictures");
  bench::add_options(app, options.pictures);
  app.add_option("--weights", options.weights, "of networks for normals, or of editing")->required();
  return bench::run_tool("normals_errors", app, argc, argv, [&] { return judge(options); });
}
