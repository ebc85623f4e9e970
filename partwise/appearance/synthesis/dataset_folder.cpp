#include "partwise/appearance/synthesis/dataset_folder.h"

#include <fmt/format.h>
#include <algorithm>

#include <nlohmann/json.hpp>
#include <vector>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/appearance/shapes/shape_fields.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

using Json = nlohmann::ordered_json;

Json named_files(const DatasetConfig& config, const std::vector<std::string>& names,
                 bool (*is_file)(const std::string&)) {
  Json list = Json::array();
  for (const std::string& name : names) {
    Json entry = {{"name", name}};
    if (is_file(name)) entry["bytes"] = std::filesystem::file_size(config.folder / name);
    list.push_back(std::move(entry));
  }
  return list;
}

// All that the bytes of the shards depend on.
Json origin(const DatasetConfig& config) {
  Json shapes = Json::array();
  for (const ShapeFile& shape : config.shapes) {
    shapes.push_back(
        {{"file", shape.file.string()}, {"bytes", std::filesystem::file_size(config.folder / shape.file)}});
    if (!shape.model.empty()) shapes.back()["model"] = shape.model;
    if (!shape.labels.empty()) {
      shapes.back()["labels"] = shape.labels.string();
      shapes.back()["label_bytes"] = std::filesystem::file_size(config.folder / shape.labels);
    }
  }
  return {
      {"images", config.images},
      {"images_per_shard", config.images_per_shard},
      {"format", config.format == ImageFormat::exr ? "exr" : "png"},
      {"seed", config.seed},
      {"size", {config.size.width, config.size.height}},
      {"samples", config.size.samples},
      {"light_size", {config.light_width, config.light_height}},
      {"path", config.path == RenderPath::exact ? "exact" : "reflectance_map"},
      {"map_size", config.map_size},
      {"elevation", config.view.elevation},
      {"share", config.view.share},
      {"viewpoints", config.viewpoints},
      {"views", config.views},
      {"parts", word_of(config.parts.rule)},
      {"groups", config.parts.groups},
      {"tolerance", config.parts.tolerance},
      {"crease", config.crease_degrees},
      {"lights", named_files(config, config.lights, is_light_file)},
      {"materials", named_files(config, config.materials, is_material_file)},
      {"shapes", shapes},
  };
}

std::string shown(const Json& value) {
  const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() > 40 ? fmt::format("{} entries", value.size()) : text;
}

void refuse_other(const std::filesystem::path& file, const Json& before, const Json& now) {
  const char* const remedy = "give another output folder, or remove this one";
  if (!before.is_object()) throw InputError(file.string(), "is not what a data set was made from", remedy);
  for (const auto& [name, value] : now.items()) {
    if (!before.contains(name)) throw InputError(file.string(), fmt::format("lacks {}", name), remedy);
    if (before[name] == value) continue;
    const std::string other = shown(before[name]), own = shown(value);
    throw InputError(file.string(),
                     other == own ? fmt::format("the folder's data was made from other {}", name)
                                  : fmt::format("the folder's data was made with {} {}, not {}", name, other, own),
                     remedy);
  }
}

}  // namespace

DatasetFolder::DatasetFolder(const DatasetConfig& config) : folder_(config.output) {
  const std::filesystem::path file = folder_ / "dataset.json";
  const Json now = origin(config);
  if (std::filesystem::exists(file)) {
    const Json before = Json::parse(read_bytes(file), nullptr, false);
    if (before == now) return;
    if (has_shards()) refuse_other(file, before, now);
  }
  std::error_code error;
  std::filesystem::remove_all(parts(), error);  // of other shapes
  std::filesystem::create_directories(parts(), error);
  if (error) {
    throw InputError(folder_.string(), fmt::format("cannot be made ({})", error.message()),
                     "name a folder that you may write to");
  }
  write_file(file, now.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

bool DatasetFolder::has_shards() const {
  return std::ranges::any_of(std::filesystem::directory_iterator(folder_),
                             [](const auto& entry) { return entry.path().extension() == ".tar"; });
}

std::filesystem::path DatasetFolder::shard(int number) const {
  return folder_ / fmt::format("shard-{:06}.tar", number);
}

void DatasetFolder::remove_rest(int number) const {
  const std::string name = shard(number).filename().string() + ".";
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string each = entry.path().filename().string();
    if (each.starts_with(name) && each.ends_with(".tmp")) std::filesystem::remove(entry.path(), ignored);
  }
}

}  // namespace partwise
