#include "partwise/appearance/synthesis/dataset_config.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <tuple>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/shapes/model_archive.h"
#include "partwise/appearance/shapes/shape_fields.h"
#include "partwise/appearance/synthesis/dataset_fields.h"
#include "partwise/appearance/synthesis/file_patterns.h"
#include "partwise/base/error.h"
#include "partwise/base/json_fields.h"

namespace partwise {
namespace {

using nlohmann::json;

class ConfigReader {
 public:
  // Of the object at `place` of a file, which names files relative to `folder`.
  ConfigReader(std::filesystem::path path, std::string place, std::filesystem::path folder)
      : path_(std::move(path)), place_(std::move(place)) {
    config_.folder = std::move(folder);
  }

  DatasetConfig read(const json& whole) {
    JsonFields fields = object("", whole);
    read_shapes(fields);
    config_.parts = take_part_settings(fields, config_.parts.rule);
    expect_labels(fields);
    config_.crease_degrees = fields.number("crease", config_.crease_degrees, 0, 180);
    config_.materials = materials(fields);
    config_.lights = lights(fields);
    read_rendering(fields);
    read_counts(fields);
    fields.refuse_others();
    return std::move(config_);
  }

 private:
  JsonFields object(const std::string& place, const json& value) const {
    const char* dot = place_.empty() || place.empty() ? "" : ".";
    return {path_.string(), place_ + dot + place, value, "docs/dataset.md"};
  }

  std::vector<std::string> files(const JsonFields& fields, const std::string& place, const std::string& pattern) const {
    std::vector<std::string> found = files_matching(config_.folder, pattern);
    if (found.empty()) {
      const bool one = !is_pattern(pattern);
      fields.refuse(
          place, fmt::format("\"{}\" {}", pattern, one ? "does not exist" : "matches no file"),
          fmt::format("name files relative to {}", config_.folder.empty() ? "this folder" : config_.folder.string()));
    }
    return found;
  }

  void read_shapes(JsonFields& fields) {
    const json& shapes = fields.need("shapes");
    if (!shapes.is_array() || shapes.empty()) fields.refuse("shapes", "is no list of shapes", "write [\"...\"]");
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const std::string place = fmt::format("shapes[{}]", i);
      if (shapes[i].is_string()) {
        for (const std::string& file : files(fields, place, shapes[i].get<std::string>())) add_shapes(file);
      } else if (shapes[i].is_object() && shapes[i].contains("mesh")) {
        add_labelled(place, shapes[i]);
      } else {
        add_models(place, shapes[i]);
      }
    }
  }

  // A mesh with its parts.
  void add_labelled(const std::string& place, const json& value) {
    JsonFields fields = object(place, value);
    for (const char* name : {"mesh", "labels"}) {
      const std::string file = fields.text(name);
      std::error_code error;
      if (!std::filesystem::exists(config_.folder / file, error)) {
        fields.refuse(name, fmt::format("\"{}\" does not exist", file), "name one file, which is no pattern here");
      }
    }
    config_.shapes.push_back({fields.text("mesh"), "", fields.text("labels")});
    fields.refuse_others();
  }

  void expect_labels(const JsonFields& fields) const {
    const bool wanted = config_.parts.rule == PartRule::labels;
    for (const ShapeFile& shape : config_.shapes) {
      if (wanted == !shape.labels.empty()) continue;
      fields.refuse("parts",
                    wanted ? fmt::format("are labels, and {} has none", shape.file.string())
                           : fmt::format("are not labels, and {} has some", shape.file.string()),
                    wanted ? "write {\"mesh\": ..., \"labels\": ...} for each shape" : "write \"parts\": \"labels\"");
    }
  }

  void add_shapes(const std::string& file) {
    if (!is_archive(file)) return config_.shapes.push_back({file});
    const ModelArchive archive(config_.folder / file);
    for (const CatalogueModel& model : archive.models()) config_.shapes.push_back({file, model.id});
  }

  // Of an archive those that are named, or of some categories, or all; less some.
  void add_models(const std::string& place, const json& value) {
    JsonFields fields = object(place, value);
    const std::string file = fields.text("archive");
    const ModelArchive archive(config_.folder / file);
    const auto listed = [&](const char* name) {
      return fields.has(name) ? fields.texts(name) : std::vector<std::string>();
    };
    const std::vector<std::string> ids = listed("ids"), categories = listed("categories"), except = listed("except");
    fields.refuse_others();
    if (!ids.empty() && !categories.empty()) fields.refuse("ids", "and categories are both there", "keep one");
    for (const auto* names : {&ids, &except})
      for (const std::string& id : *names) archive.model(id);  // is there
    for (const std::string& category : categories) {
      if (std::ranges::find(archive.models(), category, &CatalogueModel::category) == archive.models().end()) {
        fields.refuse("categories", fmt::format("\"{}\" is none of the archive's", category),
                      fmt::format("\"{}\" is one", archive.models().front().category));
      }
    }
    const std::size_t before = config_.shapes.size();
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
      return std::ranges::find(names, name) != names.end();
    };
    for (const CatalogueModel& model : archive.models()) {
      const bool wanted = ids.empty() ? categories.empty() || has(categories, model.category) : has(ids, model.id);
      if (wanted && !has(except, model.id)) config_.shapes.push_back({file, model.id});
    }
    if (config_.shapes.size() == before) fields.refuse("except", "leaves no model", "name fewer");
  }

  // A list of what ships, by names, and of patterns of files.
  std::vector<std::string> names_or_files(JsonFields& fields, const std::string& place,
                                          bool (*is_file)(const std::string&), const std::vector<std::string>& shipped,
                                          const std::string& wrong, const std::string& remedy) const {
    std::vector<std::string> result;
    for (const std::string& name : fields.texts(place)) {
      if (is_file(name)) {
        std::ranges::copy(files(fields, place, name), std::back_inserter(result));
      } else if (std::ranges::binary_search(shipped, name)) {
        result.push_back(name);
      } else {
        fields.refuse(place, fmt::format("\"{}\" {}", name, wrong), remedy);
      }
    }
    return result;
  }

  std::vector<std::string> materials(JsonFields& fields) const {
    std::vector<std::string> shipped = shipped_materials();
    const json& given = fields.need("materials");
    if (given == "all") return shipped;
    if (given == "training") return training_materials();
    if (given == "test") return test_materials();
    return names_or_files(fields, "materials", is_material_file, shipped, "is no shipped material and no file",
                          "choose names that partwise material list gives, all, training or test");
  }

  std::vector<std::string> lights(JsonFields& fields) const {
    std::vector<std::string> shipped = shipped_lights();
    if (fields.need("lights") == "all") return shipped;
    return names_or_files(fields, "lights", is_light_file, shipped, "is no shipped light and no .exr or .hdr file",
                          fmt::format("take some of {}, or all", fmt::join(shipped, ", ")));
  }

  void read_rendering(JsonFields& fields) {
    std::tie(config_.light_width, config_.light_height) =
        fields.two_sizes("light_size", {config_.light_width, config_.light_height});
    std::tie(config_.size.width, config_.size.height) =
        fields.two_sizes("size", {config_.size.width, config_.size.height});
    config_.size.samples = fields.whole("samples", config_.size.samples, 1, 256);
    config_.path = fields.choice<RenderPath>(
        "path", config_.path, {{"exact", RenderPath::exact}, {"reflectance_map", RenderPath::reflectance_map}});
    config_.map_size = fields.whole("map_size", config_.map_size, 8, 2048);
    config_.view.elevation = fields.number("elevation", config_.view.elevation, -90, 90);
    config_.view.share = fields.number("share", config_.view.share, 0.01, 0.9);
    config_.format =
        fields.choice<ImageFormat>("format", config_.format, {{"exr", ImageFormat::exr}, {"png", ImageFormat::png}});
  }

  void read_counts(JsonFields& fields) {
    config_.viewpoints = fields.whole("viewpoints", config_.viewpoints, 1, 100000);
    config_.views = fields.whole("views", std::min(config_.views, config_.viewpoints), 1, 100000);
    if (config_.views > config_.viewpoints) {
      fields.refuse("views", fmt::format("is more than the {} viewpoints", config_.viewpoints), "give fewer");
    }
    config_.seed = static_cast<std::uint64_t>(fields.whole("seed", 0, 0, 2147483647));
    fields.need("images");
    config_.images = fields.whole("images", 0, 1, 2000000000);
    config_.images_per_shard = fields.whole("images_per_shard", config_.images_per_shard, 1, 1000000);
    if (fields.has("output")) config_.output = config_.folder / fields.text("output");
  }

  std::filesystem::path path_;
  std::string place_;
  DatasetConfig config_;
};

}  // namespace

DatasetConfig read_dataset_config(const std::filesystem::path& path) {
  return dataset_config_at(read_json(path), path, "", path.parent_path());
}

DatasetConfig dataset_config_at(const json& object, const std::filesystem::path& file, const std::string& place,
                                const std::filesystem::path& folder) {
  return ConfigReader(file, place, folder).read(object);
}

}  // namespace partwise
