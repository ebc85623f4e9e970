#include "partwise/normals/scenes/room_dataset.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <tuple>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/synthesis/dataset_fields.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/imaging/png.h"
#include "partwise/normals/truth/normal_files.h"

namespace partwise {
namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

constexpr int most_materials = 255;  // codes of 8 bits
constexpr std::uint64_t draw_purpose = 0x726f6f6d;

Furniture furniture_of(ShapeFile file, const RoomDatasetConfig& config) {
  file.file = config.folder / file.file;
  if (!file.labels.empty()) file.labels = config.folder / file.labels;
  Furniture piece;
  piece.mesh = read_shape(file);
  if (config.height > 0 && !is_archive(file.file)) {
    const double tall = piece.mesh.vertices.col(1).maxCoeff() - piece.mesh.vertices.col(1).minCoeff();
    if (tall > 0) piece.mesh.vertices *= config.height / tall;
  }
  piece.part_of_face = worn_parts(file, piece.mesh, config.parts);
  piece.parts = 1 + *std::ranges::max_element(piece.part_of_face);
  return piece;
}

// What a light brings from each pixel of a small map in camera space: energy is kept.
Image about_camera(const EnvironmentLight& light, const Camera& camera) {
  constexpr int width = RoomTruth::light_columns, height = RoomTruth::light_rows;
  Image map(width, height, 3);
  for (int y = 0; y < light.height(); ++y) {
    for (int x = 0; x < light.width(); ++x) {
      const Eigen::Vector3d from = camera.axes * equirectangular_direction(x, y, light.width(), light.height());
      const double u = std::atan2(from.x(), -from.z()) / (2 * std::numbers::pi) + 0.5,
                   v = std::acos(std::clamp(from.y(), -1.0, 1.0)) / std::numbers::pi;
      const int column = std::clamp(static_cast<int>(u * width), 0, width - 1),
                row = std::clamp(static_cast<int>(v * height), 0, height - 1);
      const double share = light.solid_angle(y) / equirectangular_solid_angle(row, width, height);
      for (int k = 0; k < 3; ++k)
        map.pixel(column, row)[k] += static_cast<float>(share) * light.radiance().pixel(x, y)[k];
    }
  }
  return map;
}

double median_luminance(const Image& image) {
  std::vector<float> values;
  for (std::size_t i = 0; i < image.values.size(); i += 3)
    values.push_back(0.2126f * image.values[i] + 0.7152f * image.values[i + 1] + 0.0722f * image.values[i + 2]);
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return static_cast<double>(*middle);
}

void scale(Image& image, double factor) {
  for (float& value : image.values) value *= static_cast<float>(factor);
}

// With the codes that a format has.
Image coded(int width, int height, double largest, const auto& code_of_pixel) {
  Image codes(width, height, 1);
  for (std::size_t i = 0; i < codes.values.size(); ++i)
    codes.values[i] = static_cast<float>(std::clamp(std::round(code_of_pixel(i)), 0.0, largest) / largest);
  return codes;
}

class Rooms {
 public:
  Rooms(const RoomDatasetConfig& config, const Progress& progress)
      : config_(config), basis_(shipped_basis().first(default_components)) {
    furniture_.resize(config.shapes.size());
    const auto size = static_cast<int>(config.shapes.size());
    in_slices(size, "furniture", progress, [&](int i) {
      furniture_[static_cast<std::size_t>(i)] = furniture_of(config.shapes[static_cast<std::size_t>(i)], config);
    });
    for (const std::string& name : config.materials) {
      const auto material = std::dynamic_pointer_cast<const Dsbrdf>(find_material(name, config.folder));
      if (material == nullptr) throw InputError(name, "is measured, not fitted", "fit it with partwise material fit");
      materials_.push_back(material->coefficients());
      numbers_.push_back(basis_.project(*material));
    }
    for (const std::string& name : config.lights)
      lights_.push_back(named_light(name, config.folder).resized(config.light_width, config.light_height));
  }

  // work(i) on all threads, progress and stopping in between.
  template <typename Work>
  static void in_slices(int count, const char* what, const Progress& progress, const Work& work) {
    constexpr int slice = 16;
    for (int first = 0; first < count; first += slice) {
      progress(what, static_cast<double>(first) / count);
      tbb::parallel_for(first, std::min(first + slice, count), work);
    }
  }

  void make(int number) const {
    Draw draw(config_.seed, static_cast<std::uint64_t>(number), draw_purpose);
    const Room room = drawn_room(furniture_, draw, config_.room);
    const DrawnWear wear = drawn_wear(room.parts, materials_, draw, config_.wear);
    const auto chosen_light = static_cast<std::size_t>(draw.below(static_cast<int>(lights_.size())));
    const EnvironmentLight light = lights_[chosen_light].rotated(draw.within(0, 360));
    const double stops = draw.within(-0.75, 0.75);
    RoomPictureSettings settings = config_.picture;
    settings.seed = static_cast<std::uint64_t>(draw.below(1 << 30));
    RoomPicture picture = room_picture(room, wear, light, settings);

    constexpr double grey = 0.18, darkest = 1e-6;
    const double exposure = grey * std::exp2(stops) / std::max(darkest, median_luminance(picture.image));
    scale(picture.image, exposure);
    Image about = about_camera(light, room.camera);
    scale(about, exposure);
    write(number, picture, truth(wear, config_.lights[chosen_light], about));
  }

 private:
  Json truth(const DrawnWear& wear, const std::string& light, const Image& about) const {
    Json materials = Json::array();
    for (const int each : wear.chosen) {
      const auto place = static_cast<std::size_t>(each);
      const Eigen::VectorXf numbers = numbers_[place].cast<float>();
      materials.push_back(
          {{"name", config_.materials[place]}, {"numbers", std::vector<float>(numbers.begin(), numbers.end())}});
    }
    return {{"materials", materials},
            {"light", {{"name", light}, {"columns", about.width}, {"rows", about.height}, {"radiance", about.values}}}};
  }

  Path file(const char* folder, int number, const char* ending) const {
    return config_.output / folder / fmt::format("{:06}{}", number, ending);
  }

  // The colours last: a frame that has them is whole.
  void write(int number, const RoomPicture& picture, const Json& truth) const {
    const int width = picture.image.width, height = picture.image.height;
    constexpr double millimetres = 1000;
    write_normals(file("normals", number, ".png"), picture.normals);
    write_png(file("depth", number, ".png"),
              coded(width, height, 65535,
                    [&](std::size_t i) { return millimetres * static_cast<double>(picture.sensed.values[i]); }),
              PngCodes::plain16);
    write_png(file("materials", number, ".png"),
              coded(width, height, 255, [&](std::size_t i) { return picture.materials[i] + 1.0; }), PngCodes::plain8);
    write_file(file("truth", number, ".json"), truth.dump() + "\n");
    write_png(file("color", number, ".png"), picture.image);
  }

  const RoomDatasetConfig& config_;
  DsbrdfBasis basis_;
  std::vector<Furniture> furniture_;
  std::vector<DsbrdfCoefficients> materials_;
  std::vector<Eigen::VectorXd> numbers_;  // of the basis
  std::vector<EnvironmentLight> lights_;
};

void begin_folder(const RoomDatasetConfig& config) {
  const Path about = config.output / "rooms.json";
  if (std::filesystem::exists(about)) {
    if (read_bytes(about) == config.text) return;
    throw InputError(config.output.string(), "holds rooms of another configuration", "name another folder");
  }
  std::error_code error;
  for (const char* each : {"color", "depth", "normals", "materials", "truth"})
    if (!error) std::filesystem::create_directories(config.output / each, error);
  if (error) throw InputError(config.output.string(), "cannot be made", "name a folder that you may write to");
  const double focal = config.picture.size.height / (2 * std::tan(config.room.field_of_view * std::numbers::pi / 360));
  write_file(config.output / "intrinsics.txt",
             fmt::format("{0:.9g} 0 {1:.9g}\n0 {0:.9g} {2:.9g}\n0 0 1\n", focal, (config.picture.size.width - 1) / 2.0,
                         (config.picture.size.height - 1) / 2.0));
  write_file(about, config.text);
}

Path beside(const Path& colour, const char* folder, const char* ending) {
  return colour.parent_path().parent_path() / folder / (colour.stem().string() + ending);
}

}  // namespace

RoomDatasetConfig read_room_dataset_config(const Path& path, std::uint64_t seed) {
  nlohmann::json whole = read_json(path);
  if (seed != 0 && whole.is_object()) whole["seed"] = seed;
  JsonFields fields(path.string(), "", whole, "docs/rooms.md");
  RoomDatasetConfig config;
  config.folder = path.parent_path();
  static_cast<DatasetSources&>(config) = take_sources(fields, config.folder);
  config.parts = take_parts_of(fields, config.shapes);
  config.height = fields.number("height", config.height, 0, 10);
  config.room.least_pieces = fields.whole("least_pieces", config.room.least_pieces, 0, 100);
  config.room.most_pieces = fields.whole("most_pieces", std::max(config.room.least_pieces, config.room.most_pieces),
                                         config.room.least_pieces, 100);
  config.room.field_of_view = fields.number("field_of_view", config.room.field_of_view, 5, 120);
  config.wear.materials = fields.whole("room_materials", config.wear.materials, 1, most_materials);
  config.wear.patterned = fields.number("patterned", config.wear.patterned, 0, 1);
  RasterSize& size = config.picture.size;
  std::tie(size.width, size.height) = fields.two_sizes("size", {size.width, size.height});
  size.samples = fields.whole("samples", size.samples, 1, 256);
  config.picture.map_size = fields.whole("map_size", config.picture.map_size, 8, 2048);
  std::tie(config.light_width, config.light_height) =
      fields.two_sizes("light_size", {config.light_width, config.light_height});
  config.seed = static_cast<std::uint64_t>(fields.whole("seed", 0, 0, 2147483647));
  fields.need("images");
  config.images = fields.whole("images", 0, 1, 1000000);
  if (fields.has("output")) config.output = config.folder / fields.text("output");
  fields.refuse_others();
  for (const char* each : {"output", "images"}) whole.erase(each);  // more of them may be asked for later
  config.text = whole.dump(1) + "\n";
  return config;
}

RoomDatasetReport make_room_dataset(const RoomDatasetConfig& config, const Progress& progress) {
  begin_folder(config);
  RoomDatasetReport report;
  std::vector<int> missing;
  for (int i = 0; i < config.images; ++i)
    if (!std::filesystem::exists(config.output / "color" / fmt::format("{:06}.png", i))) missing.push_back(i);
  report.made = static_cast<int>(missing.size());
  report.kept = config.images - report.made;
  if (missing.empty()) return report;
  const Rooms rooms(config, progress);
  const auto start = std::chrono::steady_clock::now();
  Rooms::in_slices(report.made, "rooms", progress, [&](int i) { rooms.make(missing[static_cast<std::size_t>(i)]); });
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

Path room_normals_file(const Path& colour) { return beside(colour, "normals", ".png"); }

bool has_room_truth(const Path& colour) { return std::filesystem::exists(beside(colour, "truth", ".json")); }

RoomTruth read_room_truth(const Path& colour) {
  const Path path = beside(colour, "truth", ".json");
  const nlohmann::json whole = read_json(path);
  RoomTruth truth;
  try {
    for (const auto& each : whole.at("materials")) {
      truth.names.push_back(each.at("name"));
      truth.materials.push_back(each.at("numbers"));
    }
    const auto& light = whole.at("light");
    truth.light = Image(RoomTruth::light_columns, RoomTruth::light_rows, 3);
    truth.light.values = light.at("radiance").get<std::vector<float>>();
  } catch (const nlohmann::json::exception&) {
    truth.light.values.clear();
  }
  const auto wrong_count = [](const std::vector<float>& numbers) { return numbers.size() != default_components; };
  if (truth.light.values.size() != std::size_t{3} * RoomTruth::light_columns * RoomTruth::light_rows ||
      truth.materials.empty() || std::ranges::any_of(truth.materials, wrong_count))
    throw InputError(path.string(), "is no truth of a room", "make the rooms again");
  return truth;
}

std::vector<int> read_room_materials(const Path& colour, int width, int height) {
  const Path path = beside(colour, "materials", ".png");
  const Image codes = read_plain_png(path);
  if (codes.channels != 1 || codes.width != width || codes.height != height)
    throw InputError(path.string(),
                     fmt::format("is {} x {} of {} channels, not {} x {} of one", codes.width, codes.height,
                                 codes.channels, width, height),
                     "make the rooms again");
  std::vector<int> result(codes.values.size());
  std::ranges::transform(codes.values, result.begin(),
                         [](float value) { return static_cast<int>(std::lround(255 * value)) - 1; });
  return result;
}

}  // namespace partwise
