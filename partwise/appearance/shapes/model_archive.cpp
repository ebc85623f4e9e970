#include "partwise/appearance/shapes/model_archive.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "partwise/appearance/shapes/java_properties.h"
#include "partwise/appearance/shapes/zip_entry.h"
#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise {
namespace {

constexpr char kCatalogue[] = "PluginFurnitureCatalog.properties";
constexpr double kMetresPerUnit = 0.01;  // catalogues are in centimetres

using Properties = std::map<std::string, std::string>;

std::string value_or(const Properties& properties, const std::string& key, const std::string& otherwise = {}) {
  const auto found = properties.find(key);
  return found == properties.end() ? otherwise : found->second;
}

std::vector<double> numbers(const std::string& place, const std::string& text) {
  std::istringstream words(text);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      throw InputError(place, fmt::format("\"{}\" is not a number", word), "mend the catalogue");
    }
    values.push_back(value);
  }
  return values;
}

CatalogueModel catalogue_model(const std::string& archive, const Properties& properties, int number) {
  const auto key = [&](const char* name) { return fmt::format("{}#{}", name, number); };
  CatalogueModel model;
  const std::string id = value_or(properties, key("id"), std::to_string(number));
  model.id = id.substr(id.rfind('#') + 1);
  model.name = value_or(properties, key("name"));
  model.category = value_or(properties, key("category"));
  model.creator = value_or(properties, key("creator"));
  model.licence = value_or(properties, key("license"), value_or(properties, "license"));
  model.file = properties.at(key("model"));
  model.file.erase(0, model.file.find_first_not_of('/'));
  const std::string place = fmt::format("{}:{}", archive, kCatalogue);
  const std::vector<double> turn = numbers(place, value_or(properties, key("modelRotation")));
  if (!turn.empty() && turn.size() != 9) {
    throw InputError(place, fmt::format("modelRotation#{} has {} numbers", number, turn.size()), "give 9");
  }
  if (!turn.empty()) model.rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(turn.data());
  int axis = 0;
  for (const char* name : {"width", "height", "depth"}) {
    const std::vector<double> length = numbers(place, value_or(properties, key(name)));
    model.size[axis++] = length.empty() ? 0 : kMetresPerUnit * length.front();
  }
  return model;
}

// Extents that the catalogue gives, where both it and the mesh have one.
void place_as_catalogued(Mesh& mesh, const CatalogueModel& model) {
  mesh.vertices = (mesh.vertices * model.rotation.transpose()).eval();
  const Eigen::RowVector3d low = mesh.vertices.colwise().minCoeff(), high = mesh.vertices.colwise().maxCoeff();
  mesh.vertices.rowwise() -= (low + high) / 2;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = high[axis] - low[axis];
    mesh.vertices.col(axis) *= extent > 0 && model.size[axis] > 0 ? model.size[axis] / extent : kMetresPerUnit;
  }
}

}  // namespace

ModelArchive::ModelArchive(std::filesystem::path path) : path_(std::move(path)) {
  const Properties properties = read_properties(read_zip_entry(path_, kCatalogue));
  for (int number = 1; properties.contains(fmt::format("model#{}", number)); ++number)
    models_.push_back(catalogue_model(path_.string(), properties, number));
  if (models_.empty()) throw InputError(path_.string(), "its catalogue lists no models", "give another archive");
}

const CatalogueModel& ModelArchive::model(const std::string& id) const {
  const auto found = std::ranges::find(models_, id, &CatalogueModel::id);
  if (found != models_.end()) return *found;
  throw InputError(path_.string(), fmt::format("has no model \"{}\" among its {}", id, models_.size()),
                   fmt::format("\"{}\" is one that it has", models_.front().id));
}

Mesh ModelArchive::read(const std::string& id) const {
  const CatalogueModel& found = model(id);
  Mesh mesh = read_mesh(path_.string() + ":" + found.file, bytes(id));
  place_as_catalogued(mesh, found);
  if (!mesh.vertices.allFinite()) {
    throw InputError(path_.string() + ":" + found.file, "is too large once placed as the catalogue says",
                     "mend the catalogue");
  }
  return mesh;
}

std::string ModelArchive::bytes(const std::string& id) const { return read_zip_entry(path_, model(id).file); }

}  // namespace partwise
