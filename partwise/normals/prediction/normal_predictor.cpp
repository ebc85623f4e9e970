#include "partwise/normals/prediction/normal_predictor.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <torch/nn/module.h>

#include <nlohmann/json.hpp>
#include <variant>

#include "partwise/base/error.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/learning/network_blocks.h"
#include "partwise/normals/prediction/scene_networks.h"

namespace partwise {
namespace {

constexpr const char* kind = "normals";
constexpr const char* editing_kind = "editing";
constexpr const char* u_name = "u";
constexpr const char* multi_branch_name = "multi_branch";

}  // namespace

struct NormalPredictor::Network {
  NormalPredictorSettings settings;
  std::variant<NormalNetwork, UNetwork> of;
};

NormalPredictor::NormalPredictor(const NormalPredictorSettings& settings) {
  if (settings.architecture == NormalArchitecture::u) {
    network_ = std::make_shared<Network>(Network{settings, UNetwork({.channels = settings.channels})});
  } else {
    const NormalNetworkSettings given{settings.size, settings.channels, settings.dropout};
    network_ = std::make_shared<Network>(Network{settings, NormalNetwork(given)});
  }
}

NormalPredictor::NormalPredictor(const NormalNetwork& network) {
  const NormalNetworkSettings& of = network.settings();
  network_ =
      std::make_shared<Network>(Network{{NormalArchitecture::multi_branch, of.size, of.channels, of.dropout}, network});
}

at::Tensor NormalPredictor::operator()(const at::Tensor& pictures) const {
  if (const auto* multi_branch = std::get_if<NormalNetwork>(&network_->of)) return (*multi_branch)(pictures);
  return unit_vectors(std::get<UNetwork>(network_->of)(pictures)) * pictures.narrow(1, 3, 1);
}

at::Tensor NormalPredictor::both_ways(const at::Tensor& pictures) const {
  const at::Tensor mirrored = (*this)(pictures.flip(3)).flip(3);
  const at::Tensor back = at::cat({-mirrored.narrow(1, 0, 1), mirrored.narrow(1, 1, 2)}, 1);
  return unit_vectors((*this)(pictures) + back);
}

const NormalPredictorSettings& NormalPredictor::settings() const { return network_->settings; }

torch::nn::Module& NormalPredictor::module() const { return *shared_module(); }

std::shared_ptr<torch::nn::Module> NormalPredictor::shared_module() const {
  return std::visit([](const auto& network) -> std::shared_ptr<torch::nn::Module> { return network.module(); },
                    network_->of);
}

WeightsFile NormalPredictor::weights() const {
  const bool u = settings().architecture == NormalArchitecture::u;
  nlohmann::ordered_json json = {
      {"architecture", u ? u_name : multi_branch_name}, {"size", settings().size}, {"channels", settings().channels}};
  if (!u) json["dropout"] = settings().dropout;
  return {kind, json.dump()};
}

NormalPredictor read_normal_predictor(const std::filesystem::path& path) {
  const std::string found = read_weights_header(path).kind;
  if (found == editing_kind) return NormalPredictor(read_editing_networks(path).normal_network());
  if (found == SceneNetworks::kind) return read_scene_networks(path).normals();
  const auto json = nlohmann::json::parse(read_weights_settings(path, kind));
  NormalPredictorSettings settings;
  settings.architecture = json.at("architecture") == u_name ? NormalArchitecture::u : NormalArchitecture::multi_branch;
  settings.size = json.at("size");
  settings.channels = json.at("channels");
  settings.dropout = json.value("dropout", settings.dropout);
  NormalPredictor predictor(settings);
  read_weights(path, predictor.module());
  predictor.module().eval();
  return predictor;
}

NormalPredictor read_scene_predictor(const std::filesystem::path& path) {
  NormalPredictor predictor = read_normal_predictor(path);
  if (predictor.settings().architecture != NormalArchitecture::u)
    throw InputError(path.string(), "reads single objects", "give weights of a network for scenes");
  return predictor;
}

void read_normal_weights(const std::filesystem::path& path, const NormalPredictor& predictor) {
  const NormalPredictor other = read_normal_predictor(path);
  const NormalPredictorSettings &found = other.settings(), &wanted = predictor.settings();
  const bool any_size = wanted.architecture == NormalArchitecture::u;
  if (found.architecture != wanted.architecture || found.channels != wanted.channels ||
      (found.size != wanted.size && !any_size))
    throw InputError(path.string(), "is of a network of another architecture, size or width",
                     "give weights of the same network");
  const at::NoGradGuard no_gradient;
  const auto from = other.module().parameters(), to = predictor.module().parameters();
  for (std::size_t i = 0; i < to.size(); ++i) to[i].copy_(from[i]);
}

}  // namespace partwise
