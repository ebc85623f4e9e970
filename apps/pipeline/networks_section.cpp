#include <fmt/format.h>

#include <utility>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "pipeline/stages.h"

namespace partwise::pipeline {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* config_file = "configuration.json";
constexpr int most_threads = 4096;

class TrainingPlanner {
 public:
  TrainingPlanner(const Places& places, const std::string& network, const json& section)
      : places_(places),
        fields_(places.object("training." + network, section)),
        own_(section),
        job_{.stage = "training", .name = "training/" + network, .checked_as = "training." + network} {
    for (const char* name : {"network", "output"}) {
      if (fields_.has(name)) fields_.refuse(name, "is the pipeline's affair", "leave it out here");
    }
    own_["network"] = network;
    if (!own_.contains("seed") && places.seed != 0) own_["seed"] = places.seed;
  }

  Job job(bool has_images) {
    take_threads();
    if (fields_.whole("validation_batches", 1, 0, most_threads) == 0) {
      fields_.refuse("validation_batches", "is 0", "give 1 or more: they tell which network is the best");
    }
    take_views(has_images);
    rename_among("materials", is_material_file);
    rename_among("lights", is_light_file);
    for (const char* field : {"start", "readers"}) {
      if (own_.contains(field)) rename_weights(field);
    }
    job_.words = {plain("train"), output(config_file), plain("-o"), output("."), plain("--resume")};
    job_.given = {{config_file, own_.dump(1) + "\n"}};
    job_.outputs = {"best.pt"};
    // Logs hold times, and libtorch writes the optimiser in the order of addresses.
    job_.accessories = {"log.jsonl", "events.out.tfevents.", "checkpoint.pt"};
    job_.goes_on = job_.wide = true;
    return job_;
  }

 private:
  void take_threads() {
    job_.threads = fields_.whole("threads", 0, 1, most_threads);
    own_.erase("threads");
  }

  void take_views(bool has_images) {
    if (own_.contains("views")) {
      rename_folders("views");
    } else if (has_images) {
      own_["views"] = {places_.from(job_.name, places_.output / "images")};
      job_.inputs.push_back(places_.output / "images");
    } else {
      fields_.refuse("views", "is missing", "give folders of shards, or a section \"images\", which makes some");
    }
    if (own_.contains("validation_views")) rename_folders("validation_views");
  }

  void rename_folders(const char* field) {
    const std::vector<std::string> names = fields_.texts(field);
    own_[field] = json::array();
    for (const std::string& name : names) {
      const fs::path folder = absolute_file(places_.folder, name);
      std::error_code error;
      if (!fs::is_directory(folder, error))
        fields_.refuse(field, fmt::format("\"{}\" is no folder", name), "correct it");
      for (const fs::directory_entry& each : fs::directory_iterator(folder)) {
        if (each.path().extension() == ".tar") job_.inputs.push_back(each.path());
      }
      own_[field].push_back(places_.from(job_.name, folder));
    }
  }

  void rename_among(const char* field, bool (*is_file)(const std::string&)) {
    if (!own_.contains(field) || !own_[field].is_array()) return;  // "all", "training"
    for (json& name : own_[field]) {
      if (name.is_string() && is_file(name.get<std::string>())) name = renamed(field, name.get<std::string>());
    }
  }

  void rename_weights(const char* field) {
    if (own_[field].is_string()) own_[field] = renamed(field, own_[field].get<std::string>());
  }

  std::string renamed(const char* field, const std::string& name) {
    const fs::path file = absolute_file(places_.folder, name);
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
      fields_.refuse(field, fmt::format("\"{}\" does not exist", name),
                     "name files relative to the configuration's folder");
    }
    job_.inputs.push_back(file);
    return places_.from(job_.name, file);
  }

  const Places& places_;
  JsonFields fields_;
  json own_;
  Job job_;
};

}  // namespace

Networks networks_sections(const Places& places, bool has_images, const json* training, const json* weights) {
  Networks result;
  const json nothing = json::object();
  JsonFields trained = places.object("training", training == nullptr ? nothing : *training);
  JsonFields given = places.object("weights", weights == nullptr ? nothing : *weights);
  for (const auto& [network, file] : {std::pair{"editing", &result.editing}, std::pair{"normals", &result.normals}}) {
    if (const json* section = trained.find(network)) {
      result.jobs.push_back(TrainingPlanner(places, network, *section).job(has_images));
      *file = places.output / result.jobs.back().name / "best.pt";
      if (given.has(network)) given.refuse(network, "is given, and training makes one", "keep one of both");
    }
    if (given.find(network) != nullptr) *file = take_file(given, network, places.folder);
  }
  trained.refuse_others();
  given.refuse_others();
  return result;
}

}  // namespace partwise::pipeline
