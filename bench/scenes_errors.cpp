// How well networks read normals off pictures of scenes, against the exact ones, and how good the normals are that a
// sensor's depth tells, which they learnt from.
//
//   scenes_errors ROOMS... --weights F.pt... [--count 200]
//
// ROOMS: folders of partwise rooms. One JSON line for the sensor, then one a network: "weights" ("sensor" of the
// first), "pictures"; "all", "edges", "curved" and "smooth" as normals_errors has them; "missing", the pixels where the
// sensor gives no normal, "wrong", those where it gives one that is more than 11.25 degrees off, and "right", the
// others; and of the picture rendered with the normals that were found and the true material and light, by the layer
// for coefficient images, "l2" and "ssim" over what is seen, against that rendered with the true normals, means over
// pictures.
#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "bench/normal_figures.h"
#include "bench/picture_difference.h"
#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/photo.h"
#include "partwise/learning/coefficient_images.h"
#include "partwise/normals/prediction/photo_normals.h"
#include "partwise/normals/scenes/room_dataset.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/normal_detail.h"
#include "partwise/normals/truth/normal_files.h"
#include "partwise/normals/truth/registration.h"
#include "partwise/normals/truth/rgbd_folder.h"

namespace {

using namespace partwise;
using nlohmann::ordered_json;

constexpr double wrong_from = 11.25;  // degrees

struct Options {
  std::vector<std::string> rooms, weights;
  int count = 200;
};

struct Scene {
  Image shown, exact, measured;
  Mask missing, wrong, right;
  at::Tensor materials, light, seen;  // 1 x 32 x H x W, 1 x 3 x h x w, 1 x 1 x H x W
};

Scene scene_of(const RgbdFiles& files) {
  Scene scene;
  const RgbdFrame frame = read_registered_frame(files);
  scene.shown = read_shown(files.colour);
  scene.exact = read_normals(room_normals_file(files.colour));
  scene.measured = normals_from_depth(frame.depth, frame.camera);
  const int width = scene.exact.width, height = scene.exact.height;
  scene.missing = scene.wrong = scene.right = Mask(width, height, 1);
  const double least = std::cos(wrong_from * std::numbers::pi / 180);
  const RoomTruth truth = read_room_truth(files.colour);
  const std::vector<int> which = read_room_materials(files.colour, width, height);
  scene.materials = at::zeros({1, default_components, height, width});
  scene.seen = at::zeros({1, 1, height, width});
  for (std::size_t i = 0; i < which.size(); ++i) {
    const float *n = &scene.measured.values[3 * i], *m = &scene.exact.values[3 * i];
    const bool none = n[0] == 0 && n[1] == 0 && n[2] == 0;
    const bool off = static_cast<double>(n[0] * m[0] + n[1] * m[1] + n[2] * m[2]) < least;
    (none ? scene.missing : off ? scene.wrong : scene.right).values[i] = 1;
    if (which[i] < 0) continue;
    scene.seen.data_ptr<float>()[i] = 1;
    for (std::size_t k = 0; k < default_components; ++k)
      scene.materials.data_ptr<float>()[k * which.size() + i] = truth.materials[static_cast<std::size_t>(which[i])][k];
  }
  scene.light = planes_of(truth.light).unsqueeze(0);
  return scene;
}

// Figures so far, of one network or of the sensor.
class Judge {
 public:
  explicit Judge(std::string name) : name_(std::move(name)) {}
  virtual ~Judge() = default;

  void look(const Scene& scene, const CoefficientBasis& basis) {
    const Image normals = found(scene);
    detail_.add(normals, scene.exact);
    missing_.add(normals, scene.exact, scene.missing);
    wrong_.add(normals, scene.exact, scene.wrong);
    right_.add(normals, scene.exact, scene.right);
    const auto rendered = [&](const Image& of) {
      return coefficient_images(planes_of(of).unsqueeze(0) * scene.seen, scene.materials, scene.light, basis);
    };
    const ordered_json errors =
        bench::difference(rendered(normals), rendered(scene.exact), scene.seen).at("same_exposure");
    l2_ += errors.at("l2").get<double>();
    ssim_ += errors.at("ssim").get<double>();
    ++pictures_;
  }

  ordered_json figures() const {
    ordered_json json = {{"weights", name_}, {"pictures", pictures_}};
    for (const auto& [name, of] : {std::pair{"all", &detail_.all},
                                   {"edges", &detail_.edges},
                                   {"curved", &detail_.curved},
                                   {"smooth", &detail_.smooth},
                                   {"missing", &missing_},
                                   {"wrong", &wrong_},
                                   {"right", &right_}})
      json[name] = bench::normal_figures(*of);
    json["l2"] = l2_ / pictures_;
    json["ssim"] = ssim_ / pictures_;
    return json;
  }

 private:
  virtual Image found(const Scene& scene) const { return scene.measured; }

  std::string name_;
  DetailMeasure detail_;
  NormalMeasure missing_, wrong_, right_;
  double l2_ = 0, ssim_ = 0;
  int pictures_ = 0;
};

class NetworkJudge final : public Judge {
 public:
  explicit NetworkJudge(const std::string& weights) : Judge(weights), predictor_(read_normal_predictor(weights)) {}

 private:
  Image found(const Scene& scene) const override { return scene_normals(predictor_, scene.shown); }
  NormalPredictor predictor_;
};

int judge(const Options& options) {
  const at::NoGradGuard no_gradient;
  const CoefficientBasis basis = CoefficientBasis::of(shipped_basis().first(default_components));
  std::vector<std::unique_ptr<Judge>> judges;
  judges.push_back(std::make_unique<Judge>("sensor"));
  for (const std::string& each : options.weights) judges.push_back(std::make_unique<NetworkJudge>(each));
  int left = options.count;
  for (const std::string& folder : options.rooms) {
    for (const RgbdFiles& files : find_rgbd_frames(folder)) {
      if (left-- <= 0) break;
      const Scene scene = scene_of(files);
      for (const auto& each : judges) each->look(scene, basis);
    }
  }
  for (const auto& each : judges) std::cout << each->figures().dump() << std::endl;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("How well networks read normals off pictures of scenes");
  app.add_option("ROOMS", options.rooms, "folders that partwise rooms made")->required();
  app.add_option("--weights", options.weights, "of networks for normals");
  app.add_option("--count", options.count, "pictures, at most");
  return bench::run_tool("scenes_errors", app, argc, argv, [&] { return judge(options); });
}
