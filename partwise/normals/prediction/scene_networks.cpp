#include "partwise/normals/prediction/scene_networks.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "partwise/appearance/material/dsbrdf_basis.h"
#include "partwise/base/error.h"
#include "partwise/learning/network_blocks.h"
#include "partwise/normals/scenes/room_dataset.h"

namespace partwise {
namespace {

struct LightModule : torch::nn::Module {
  static constexpr int field_rows = 4, field_columns = 5, width = 96;

  LightModule() {
    encoder = register_module("encoder", halving_convolutions(4, {24, 32, 48, 64, width}, Normalisation::none));
    const int numbers = 3 * RoomTruth::light_rows * RoomTruth::light_columns;
    connected_layers = register_module("connected", connected(width * field_rows * field_columns, 128, 0));
    connected_layers->push_back(torch::nn::Linear(128, numbers));
  }
  at::Tensor forward(const at::Tensor& pictures) {
    const at::Tensor fields = at::adaptive_avg_pool2d(encoder->forward(pictures), {field_rows, field_columns});
    return connected_layers->forward(fields.flatten(1))
        .reshape({-1, 3, RoomTruth::light_rows, RoomTruth::light_columns});
  }
  torch::nn::Sequential encoder{nullptr}, connected_layers{nullptr};
};

}  // namespace

struct SceneNetworks::Modules : torch::nn::Module {
  explicit Modules(const SceneNetworksSettings& given)
      : settings(given), normals({NormalArchitecture::u, given.width, given.channels, 0}) {
    register_module("normals", normals.shared_module());
    if (!settings.readers) return;
    material.emplace(UNetworkSettings{.in = 4, .out = default_components, .channels = given.channels});
    register_module("material", material->module());
    light = register_module("light", std::make_shared<LightModule>());
  }

  SceneNetworksSettings settings;
  NormalPredictor normals;
  std::optional<UNetwork> material;
  std::shared_ptr<LightModule> light;
};

SceneNetworks::SceneNetworks(const SceneNetworksSettings& settings) : modules_(std::make_shared<Modules>(settings)) {}

const NormalPredictor& SceneNetworks::normals() const { return modules_->normals; }

at::Tensor SceneNetworks::materials(const at::Tensor& pictures) const {
  PARTWISE_CHECK(settings().readers, ==, true);
  return (*modules_->material)(pictures);
}

at::Tensor SceneNetworks::log_radiance(const at::Tensor& pictures) const {
  PARTWISE_CHECK(settings().readers, ==, true);
  return modules_->light->forward(pictures);
}

const SceneNetworksSettings& SceneNetworks::settings() const { return modules_->settings; }
torch::nn::Module& SceneNetworks::module() const { return *modules_; }

WeightsFile SceneNetworks::weights() const {
  const nlohmann::ordered_json json = {
      {"width", settings().width}, {"channels", settings().channels}, {"readers", settings().readers}};
  return {kind, json.dump()};
}

SceneNetworks read_scene_networks(const std::filesystem::path& path) {
  const auto json = nlohmann::json::parse(read_weights_settings(path, SceneNetworks::kind));
  const SceneNetworks networks(SceneNetworksSettings{json.at("width"), json.at("channels"), json.at("readers")});
  read_weights(path, networks.module());
  networks.module().eval();
  return networks;
}

}  // namespace partwise
