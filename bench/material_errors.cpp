// How near models come to measured materials: fits each file (.binary or .h5) with ours, with the models of others and
// with few principal components, and prints a JSON object a line. With --models, writes the fits and the basis.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "partwise/appearance/material/dsbrdf_basis.h"
#include "partwise/appearance/material/fit_dsbrdf.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/material/microfacet_brdf.h"
#include "partwise/appearance/material/neural_brdf.h"
#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/imaging/image_metrics.h"
#include "tool.h"

namespace {

using namespace partwise;
using namespace partwise::bench;
namespace fs = std::filesystem;

constexpr int kMostComponents = 64;
constexpr int kBall = 40;  // pixels a side; the ball touches the frame

struct Options {
  std::vector<std::string> files, lights;
  std::string models;
  int rows = 64;  // of the lights
};

std::vector<std::string> training_materials() {
  std::vector<std::string> names = shipped_materials();
  std::erase_if(names,
                [test = test_materials()](const std::string& name) { return std::ranges::count(test, name) > 0; });
  return names;
}

void write_models(const Options& options) {
  const fs::path folder = fs::path(options.models) / "materials";
  fs::create_directories(folder);
  const std::vector<std::string> test = test_materials();
  std::vector<Dsbrdf> training;
  for (const std::string& file : options.files) {
    const HalfAngleTable measured = mean_over_phi(read_measured(file));
    const std::string name = fs::path(file).stem();
    const Dsbrdf fit = fit_dsbrdf(measured);
    // The basis is made from what the files hold, so that it can be made again from them.
    const std::string text = encode_material({name, log_rmse(measured, fit), fit});
    write_material(folder / (name + ".json"), decode_material(name, text));
    if (std::ranges::count(test, name) == 0) training.push_back(decode_material(name, text).brdf);
  }
  write_basis(fs::path(options.models) / "material_basis.json", principal_components(training, kMostComponents));
  std::printf("%zu materials, a basis of %d components from %zu\n", options.files.size(), kMostComponents,
              training.size());
}

std::map<std::string, std::unique_ptr<Brdf>> models_of(const HalfAngleTable& measured, const DsbrdfBasis& basis,
                                                       double& seconds) {
  std::map<std::string, std::unique_ptr<Brdf>> models;
  const auto start = std::chrono::steady_clock::now();
  const Dsbrdf fit = fit_dsbrdf(measured);
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  models["dsbrdf"] = std::make_unique<Dsbrdf>(fit);
  for (const int components : {8, 16, 32, 64}) {
    const DsbrdfBasis few = basis.first(components);
    models["pca" + std::to_string(components)] =
        std::make_unique<Dsbrdf>(few.material(fit_in_basis(few, measured, fit)));
  }
  const auto peer = [&](const std::string& name, LobeShape shape, int lobes) {
    models[name] = std::make_unique<MicrofacetBrdf>(fit_microfacets(measured, shape, lobes));
  };
  peer("lambert", LobeShape::ggx, 0);
  peer("blinn-phong", LobeShape::blinn_phong, 1);
  peer("cook-torrance", LobeShape::cook_torrance, 1);
  for (const int lobes : {1, 2, 3}) peer("ggx" + std::to_string(lobes), LobeShape::ggx, lobes);
  return models;
}

// The network itself, which knows every direction, or the table's nearest bins.
std::unique_ptr<Brdf> measured_brdf(const std::string& file) {
  if (fs::path(file).extension() == ".h5") return std::make_unique<NeuralBrdf>(read_neural_brdf(file));
  return std::make_unique<MerlTable>(read_merl(file));
}

// One image a light, by the exact sum.
std::vector<Image> balls(const GBuffer& ball, const Brdf& material, const std::vector<LightSamples>& lights) {
  std::vector<Image> images;
  for (const LightSamples& light : lights) {
    const LightSum sum(material, light);
    const std::array sums{&sum};
    images.push_back(exact_image(ball, sums));
  }
  return images;
}

// PSNR and SSIM of balls, means over the lights: exposed by the true one, gamma 2.2, over the ball.
std::pair<double, double> rendered_error(const Mask& mask, const std::vector<Image>& truth,
                                         const std::vector<Image>& model) {
  double psnr = 0, ssim = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const float exposure = exposure_by_median(truth[i], mask);
    const ImageDifference difference = compare_images(tone_map(model[i], exposure), tone_map(truth[i], exposure), mask);
    psnr += difference.psnr / static_cast<double>(truth.size());
    ssim += difference.ssim.value() / static_cast<double>(truth.size());
  }
  return {psnr, ssim};
}

void measure(const Options& options) {
  const DsbrdfBasis basis = shipped_basis();
  const std::vector<std::string> training = training_materials();
  std::vector<LightSamples> lights;
  for (const std::string& file : options.lights)
    lights.push_back(light_samples(read_light(file).resized(2 * options.rows, options.rows)));
  const GBuffer ball = ball_view(kBall, 1);
  const Mask mask = ball.mask_image();
  for (const std::string& file : options.files) {
    const auto start = std::chrono::steady_clock::now();
    const HalfAngleTable measured = mean_over_phi(read_measured(file));
    const double reading = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    double seconds = 0;
    const auto models = models_of(measured, basis, seconds);
    nlohmann::ordered_json line;
    line["material"] = fs::path(file).stem();
    line["test"] = std::ranges::count(training, fs::path(file).stem().string()) == 0;
    line["seconds_reading"] = reading;
    line["seconds_fit"] = seconds;
    const std::vector<Image> truth = balls(ball, *measured_brdf(file), lights);
    for (const auto& [name, brdf] : models) {
      line["log_rmse"][name] = log_rmse(measured, *brdf);
      if (!lights.empty()) {
        const auto [psnr, ssim] = rendered_error(mask, truth, balls(ball, *brdf, lights));
        line["psnr"][name] = psnr;
        line["ssim"][name] = ssim;
      }
    }
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("How near models come to measured materials");
  Options options;
  app.add_option("FILES", options.files, "Measured materials: .binary of MERL, .h5 of Neural-BRDF")->required();
  app.add_option("--models", options.models, "Write fits and the basis into this folder instead of measuring");
  app.add_option("--light", options.lights, "Measure balls under these maps, too (.exr, .hdr)");
  app.add_option("--rows", options.rows, "Rows of these maps, which have twice as many columns")
      ->check(CLI::PositiveNumber);
  return run_tool("material_errors", app, argc, argv, [&] {
    options.models.empty() ? measure(options) : write_models(options);
    return 0;
  });
}
