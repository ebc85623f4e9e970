// Edits of photos, to be looked at: a row a photo with the photo, what was found in it rendered anew, its normals, its
// material on a ball under its light, and the object in other materials.
//
//   photo_edits WEIGHTS PHOTO... [--material NAME...] [--refine] [-o SHEET.png]
//
// A line of JSON a photo: "photo", "l2", the mean squared error over the object of what was found and rendered anew
// (0 to 255), with --refine also "l2_before"; or "trouble", why there is none. The object is found as `partwise edit`
// finds it. Exits 0, 1 when it cannot be done, 2 for wrong usage.
#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/tool.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/editing/edit_photo.h"
#include "partwise/editing/layer_pictures.h"
#include "partwise/imaging/png.h"
#include "partwise/imaging/tile.h"

namespace {

using namespace partwise;

struct Options {
  std::string weights, sheet;
  std::vector<std::string> photos, materials = {"blue-rubber", "gold-metallic-paint", "chrome", "red-phenolic"};
  bool refine = false;
};

Image on_black(const Image& picture) {
  Image result(picture.width, picture.height, 3);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = picture.values[i / 3 * 4 + i % 3] * picture.values[i / 3 * 4 + 3];
  return result;
}

void add_row(std::vector<Image>& sheet, const Photo& photo, const PhotoLayers& layers, const EditingNetworks& networks,
             const std::vector<std::string>& materials) {
  const MaterialRange range = networks.range();
  sheet.push_back(square_picture(photo.shown, layers));
  sheet.push_back(rendered_picture(layers, range));
  sheet.push_back(normals_picture(layers));
  sheet.push_back(on_black(ball_picture(layers, range, 0, networks.settings().size)));
  for (const std::string& name : materials) {
    const std::vector worn(photo.regions.size(), shipped_material(name).brdf.coefficients());
    sheet.push_back(square_picture(edited(photo, layers, worn), layers));
  }
}

int edit_all(const Options& options) {
  const EditingNetworks networks = read_editing_networks(options.weights);
  ReadingSettings settings;
  settings.refine = options.refine;
  std::vector<Image> sheet;
  for (const std::string& path : options.photos) {
    nlohmann::ordered_json json = {{"photo", path}};
    try {
      const Photo photo = read_photo(path, {});
      const PhotoLayers layers = read_layers(networks, photo, settings);
      json["l2"] = layers.error;
      if (options.refine) json["l2_before"] = layers.error_before;
      if (!options.sheet.empty()) add_row(sheet, photo, layers, networks, options.materials);
    } catch (const InputError& error) {
      json["trouble"] = error.what();
    }
    std::cout << json.dump() << std::endl;
  }
  if (!sheet.empty())
    write_file(options.sheet,
               encode_png(tile(sheet, 4 + static_cast<int>(options.materials.size())), PngCodes::plain8));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Edits of photos, to be looked at");
  app.add_option("weights", options.weights, "of networks of editing")->required();
  app.add_option("photos", options.photos, "pictures (.png, .jpg)")->required();
  app.add_option("--material", options.materials, "shipped materials");
  app.add_flag("--refine", options.refine, "make what was found explain the photo better first");
  app.add_option("-o", options.sheet, "the sheet (.png)");
  return bench::run_tool("photo_edits", app, argc, argv, [&] { return edit_all(options); });
}
