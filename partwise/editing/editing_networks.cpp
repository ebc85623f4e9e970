#include "partwise/editing/editing_networks.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

constexpr const char* kind = "editing";
constexpr int halvings = 7;

const std::vector<int> widths = {32, 48, 64, 96, 128, 128, 160};

// Values that the seven convolutions give for a picture of a size.
int encoded(int size) {
  PARTWISE_CHECK(size, >=, 1 << halvings);
  PARTWISE_CHECK(size % 32, ==, 0);
  for (int i = 0; i < halvings; ++i) size = (size + 1) / 2;
  return widths.back() * size * size;
}

struct MaterialModule : torch::nn::Module {
  explicit MaterialModule(const EditingNetworksSettings& settings) {
    encoder = register_module("encoder", halving_convolutions(4, widths, Normalisation::none));
    connected_layers = register_module("connected", connected(encoded(settings.size), 192, settings.dropout));
    connected_layers->extend(*connected(192, 192, settings.dropout));
    connected_layers->push_back(torch::nn::Linear(192, dsbrdf_size));
  }
  at::Tensor forward(const at::Tensor& pictures) {
    return connected_layers->forward(encoder->forward(pictures).flatten(1)).tanh();
  }
  torch::nn::Sequential encoder{nullptr}, connected_layers{nullptr};
};

struct LightModule : torch::nn::Module {
  static constexpr int channels = 24, rows = light_rows / 16, columns = light_columns / 16;

  explicit LightModule(const EditingNetworksSettings& settings) {
    encoder = register_module("encoder", halving_convolutions(4, widths, Normalisation::none));
    connected_layers = register_module("connected", connected(encoded(settings.size), 256, settings.dropout));
    spread = register_module("spread", torch::nn::Linear(256, channels * rows * columns));
    decoder = register_module("decoder", doubling_convolution(channels, 48));
    decoder->extend(*doubling_convolution(48, 40));
    decoder->extend(*doubling_convolution(40, 24));
    decoder->push_back(torch::nn::ConvTranspose2d(torch::nn::ConvTranspose2dOptions(24, 3, 4).stride(2).padding(1)));
    level = register_module("level", torch::nn::Linear(256, 3));
  }
  at::Tensor forward(const at::Tensor& pictures) {
    const at::Tensor seen = connected_layers->forward(encoder->forward(pictures).flatten(1));
    const at::Tensor map = decoder->forward(spread->forward(seen).relu().reshape({-1, channels, rows, columns}));
    return map + level->forward(seen).reshape({-1, 3, 1, 1});
  }
  torch::nn::Sequential encoder{nullptr}, connected_layers{nullptr}, decoder{nullptr};
  torch::nn::Linear spread{nullptr}, level{nullptr};
};

}  // namespace

struct EditingNetworks::Modules : torch::nn::Module {
  Modules(const EditingNetworksSettings& given, const MaterialRange& range)
      : settings(given), normals({given.size, given.normal_channels, given.dropout}) {
    register_module("normals", normals.module());
    material = register_module("material", std::make_shared<MaterialModule>(settings));
    light = register_module("light", std::make_shared<LightModule>(settings));
    low = register_buffer("material_low", range.low().clone());
    high = register_buffer("material_high", range.high().clone());
  }

  EditingNetworksSettings settings;
  NormalNetwork normals;
  std::shared_ptr<MaterialModule> material;
  std::shared_ptr<LightModule> light;
  at::Tensor low, high;
};

EditingNetworks::EditingNetworks(const EditingNetworksSettings& settings, const MaterialRange& range)
    : modules_(std::make_shared<Modules>(settings, range)) {}

at::Tensor EditingNetworks::normals(const at::Tensor& pictures) const { return modules_->normals(pictures); }
at::Tensor EditingNetworks::scaled_material(const at::Tensor& pictures) const {
  return modules_->material->forward(pictures);
}
at::Tensor EditingNetworks::log_radiance(const at::Tensor& pictures) const {
  return modules_->light->forward(pictures);
}

PictureLayers EditingNetworks::operator()(const at::Tensor& pictures) const {
  return {normals(pictures), scaled_material(pictures), log_radiance(pictures)};
}

const NormalNetwork& EditingNetworks::normal_network() const { return modules_->normals; }
const EditingNetworksSettings& EditingNetworks::settings() const { return modules_->settings; }
MaterialRange EditingNetworks::range() const { return {modules_->low, modules_->high}; }
torch::nn::Module& EditingNetworks::module() const { return *modules_; }

WeightsFile EditingNetworks::weights() const {
  const nlohmann::ordered_json json = {
      {"size", settings().size}, {"normal_channels", settings().normal_channels}, {"dropout", settings().dropout}};
  return {kind, json.dump()};
}

EditingNetworks read_editing_networks(const std::filesystem::path& path) {
  const auto json = nlohmann::json::parse(read_weights_settings(path, kind));
  EditingNetworksSettings settings;
  settings.size = json.value("size", settings.size);
  settings.normal_channels = json.value("normal_channels", settings.normal_channels);
  settings.dropout = json.value("dropout", settings.dropout);
  const MaterialRange any(at::zeros({dsbrdf_size}), at::ones({dsbrdf_size}));
  EditingNetworks networks(settings, any);
  read_weights(path, networks.module());
  networks.module().eval();
  return networks;
}

at::Tensor log_of_radiance(const at::Tensor& radiance) { return (radiance + darkest_radiance).log(); }

at::Tensor radiance_of_log(const at::Tensor& log_radiance) {
  constexpr double brightest = 12;  // e^12, some thousand suns of a sky: no overflow while a network learns
  return log_radiance.clamp_max(brightest).exp();
}

}  // namespace partwise
