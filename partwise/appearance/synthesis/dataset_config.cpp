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

namespace partwise {
namespace {

using nlohmann::json;

// Shapes, materials and lights: patterns are expanded, and what is named must be there.
class SourceReader {
 public:
  SourceReader(JsonFields& fields, std::filesystem::path folder) : fields_(fields), folder_(std::move(folder)) {}

  DatasetSources read() {
    read_shapes();
    result_.materials = materials();
    result_.lights = lights();
    return std::move(result_);
  }

 private:
  std::vector<std::string> files(const std::string& place, const std::string& pattern) const {
    std::vector<std::string> found = files_matching(folder_, pattern);
    if (found.empty()) {
      const bool one = !is_pattern(pattern);
      fields_.refuse(place, fmt::format("\"{}\" {}", pattern, one ? "does not exist" : "matches no file"),
                     fmt::format("name files relative to {}", folder_.empty() ? "this folder" : folder_.string()));
    }
    return found;
  }

  void read_shapes() {
    const json& shapes = fields_.need("shapes");
    if (!shapes.is_array() || shapes.empty()) fields_.refuse("shapes", "is no list of shapes", "write [\"...\"]");
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const std::string place = fmt::format("shapes[{}]", i);
      if (shapes[i].is_string()) {
        for (const std::string& file : files(place, shapes[i].get<std::string>())) add_shapes(file);
      } else if (shapes[i].is_object() && shapes[i].contains("mesh")) {
        add_labelled(fields_.object(place, shapes[i]));
      } else {
        add_models(fields_.object(place, shapes[i]));
      }
    }
  }

  // A mesh with its parts.
  void add_labelled(JsonFields fields) {
    for (const char* name : {"mesh", "labels"}) {
      const std::string file = fields.text(name);
      std::error_code error;
      if (!std::filesystem::exists(folder_ / file, error)) {
        fields.refuse(name, fmt::format("\"{}\" does not exist", file), "name one file, which is no pattern here");
      }
    }
    result_.shapes.push_back({fields.text("mesh"), "", fields.text("labels")});
    fields.refuse_others();
  }

  void add_shapes(const std::string& file) {
    if (!is_archive(file)) return result_.shapes.push_back({file});
    const ModelArchive archive(folder_ / file);
    for (const CatalogueModel& model : archive.models()) result_.shapes.push_back({file, model.id});
  }

  // Of an archive those that are named, or of some categories, or all; less some.
  void add_models(JsonFields fields) {
    const std::string file = fields.text("archive");
    const ModelArchive archive(folder_ / file);
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
    const std::size_t before = result_.shapes.size();
    const auto has = [](const std::vector<std::string>& names, const std::string& name) {
      return std::ranges::find(names, name) != names.end();
    };
    for (const CatalogueModel& model : archive.models()) {
      const bool wanted = ids.empty() ? categories.empty() || has(categories, model.category) : has(ids, model.id);
      if (wanted && !has(except, model.id)) result_.shapes.push_back({file, model.id});
    }
    if (result_.shapes.size() == before) fields.refuse("except", "leaves no model", "name fewer");
  }

  // A list of what ships, by names, and of patterns of files.
  std::vector<std::string> names_or_files(const std::string& place, bool (*is_file)(const std::string&),
                                          const std::vector<std::string>& shipped, const std::string& wrong,
                                          const std::string& remedy) const {
    std::vector<std::string> result;
    for (const std::string& name : fields_.texts(place)) {
      if (is_file(name)) {
        std::ranges::copy(files(place, name), std::back_inserter(result));
      } else if (std::ranges::binary_search(shipped, name)) {
        result.push_back(name);
      } else {
        fields_.refuse(place, fmt::format("\"{}\" {}", name, wrong), remedy);
      }
    }
    return result;
  }

  std::vector<std::string> materials() const {
    std::vector<std::string> shipped = shipped_materials();
    const json& given = fields_.need("materials");
    if (given == "all") return shipped;
    if (given == "training") return training_materials();
    if (given == "test") return test_materials();
    return names_or_files("materials", is_material_file, shipped, "is no shipped material and no file",
                          "choose names that partwise material list gives, all, training or test");
  }

  std::vector<std::string> lights() const {
    std::vector<std::string> shipped = shipped_lights();
    if (fields_.need("lights") == "all") return shipped;
    return names_or_files("lights", is_light_file, shipped, "is no shipped light and no .exr or .hdr file",
                          fmt::format("take some of {}, or all", fmt::join(shipped, ", ")));
  }

  JsonFields& fields_;
  std::filesystem::path folder_;
  DatasetSources result_;
};

void expect_labels(const JsonFields& fields, const std::vector<ShapeFile>& shapes, PartRule rule) {
  const bool wanted = rule == PartRule::labels;
  for (const ShapeFile& shape : shapes) {
    if (wanted == !shape.labels.empty()) continue;
    fields.refuse("parts",
                  wanted ? fmt::format("are labels, and {} has none", shape.file.string())
                         : fmt::format("are not labels, and {} has some", shape.file.string()),
                  wanted ? "write {\"mesh\": ..., \"labels\": ...} for each shape" : "write \"parts\": \"labels\"");
  }
}

void read_rendering(JsonFields& fields, DatasetConfig& config) {
  std::tie(config.light_width, config.light_height) =
      fields.two_sizes("light_size", {config.light_width, config.light_height});
  std::tie(config.size.width, config.size.height) = fields.two_sizes("size", {config.size.width, config.size.height});
  config.size.samples = fields.whole("samples", config.size.samples, 1, 256);
  config.path = fields.choice<RenderPath>(
      "path", config.path, {{"exact", RenderPath::exact}, {"reflectance_map", RenderPath::reflectance_map}});
  config.map_size = fields.whole("map_size", config.map_size, 8, 2048);
  config.view.elevation = fields.number("elevation", config.view.elevation, -90, 90);
  config.view.share = fields.number("share", config.view.share, 0.01, 0.9);
  config.format =
      fields.choice<ImageFormat>("format", config.format, {{"exr", ImageFormat::exr}, {"png", ImageFormat::png}});
}

void read_counts(JsonFields& fields, DatasetConfig& config) {
  config.viewpoints = fields.whole("viewpoints", config.viewpoints, 1, 100000);
  config.views = fields.whole("views", std::min(config.views, config.viewpoints), 1, 100000);
  if (config.views > config.viewpoints) {
    fields.refuse("views", fmt::format("is more than the {} viewpoints", config.viewpoints), "give fewer");
  }
  config.seed = static_cast<std::uint64_t>(fields.whole("seed", 0, 0, 2147483647));
  fields.need("images");
  config.images = fields.whole("images", 0, 1, 2000000000);
  config.images_per_shard = fields.whole("images_per_shard", config.images_per_shard, 1, 1000000);
  if (fields.has("output")) config.output = config.folder / fields.text("output");
}

}  // namespace

DatasetConfig read_dataset_config(const std::filesystem::path& path) {
  return dataset_config_at(read_json(path), path, "", path.parent_path());
}

DatasetSources take_sources(JsonFields& fields, const std::filesystem::path& folder) {
  return SourceReader(fields, folder).read();
}

PartSettings take_parts_of(JsonFields& fields, const std::vector<ShapeFile>& shapes) {
  const PartSettings parts = take_part_settings(fields, PartSettings().rule);
  expect_labels(fields, shapes, parts.rule);
  return parts;
}

DatasetConfig dataset_config_at(const json& object, const std::filesystem::path& file, const std::string& place,
                                const std::filesystem::path& folder) {
  JsonFields fields(file.string(), place, object, "docs/dataset.md");
  DatasetConfig config;
  config.folder = folder;
  static_cast<DatasetSources&>(config) = take_sources(fields, folder);
  config.parts = take_parts_of(fields, config.shapes);
  config.crease_degrees = fields.number("crease", config.crease_degrees, 0, 180);
  read_rendering(fields, config);
  read_counts(fields, config);
  fields.refuse_others();
  return config;
}

}  // namespace partwise
