#include "bench/edit_cases.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "partwise/appearance/material/material_files.h"
#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/material_range.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/imaging/tone_mapping.h"
#include "partwise/learning/rendering_layer.h"

namespace partwise::bench {
namespace {

enum Purpose : std::uint64_t { of_view, of_light, of_materials };

// Parts are numbered from 1 in a view, not all of them need be seen.
std::vector<at::Tensor> regions_of(const at::Tensor& parts, bool apart) {
  std::vector<at::Tensor> regions;
  const auto add = [&](const at::Tensor& chosen) {
    if (chosen.any().item<bool>()) regions.push_back(chosen.to(at::kFloat).unsqueeze(0).unsqueeze(0));
  };
  if (!apart) {
    add(parts > 0);
  } else {
    for (int part = 1; part <= parts.max().item<int>(); ++part) add(parts == part);
  }
  return regions;
}

// All under one light.
at::Tensor maps_of(const at::Tensor& materials, const at::Tensor& radiance, int map_size) {
  return reflectance_maps(materials, radiance.expand({materials.size(0), -1, -1, -1}), map_size);
}

}  // namespace

void add_options(CLI::App& app, JudgedPictures& pictures) {
  app.add_option("views", pictures.views, "folders of shards")->required();
  app.add_option("--count", pictures.count, "pictures")->check(CLI::PositiveNumber);
  app.add_option("--map-size", pictures.cases.map_size, "of reflectance maps")->check(CLI::Range(8, 512));
  app.add_option("--lights", pictures.lights, "that pictures are lit by");
  app.add_option("--seed", pictures.cases.seed);
  app.add_flag("--parts", pictures.cases.parts, "each part of a view in a material of its own");
}

EditCases::EditCases(const StoredViews& views, const std::vector<std::string>& materials,
                     const std::vector<std::string>& lights, const EditCaseSettings& settings)
    : views_(views), settings_(settings) {
  PARTWISE_CHECK(views_.size(), >, 0);
  for (const std::string& each : materials) materials_.push_back(as_tensor(shipped_material(each).brdf.coefficients()));
  for (const std::string& each : lights) lights_.push_back(named_light(each).resized(light_columns, light_rows));
}

EditCase EditCases::operator()(int number) const {
  const auto draw = [&](Purpose purpose) { return Draw(settings_.seed, static_cast<std::uint64_t>(number), purpose); };
  const int view = draw(of_view).below(static_cast<int>(views_.size()));
  Draw of_the_light = draw(of_light);
  const EnvironmentLight& any = lights_[static_cast<std::size_t>(of_the_light.below(static_cast<int>(lights_.size())))];

  EditCase result;
  result.regions = regions_of(views_.parts(view), settings_.parts);
  result.normals = views_.normals(view).unsqueeze(0);
  result.radiance = planes_of(any.rotated(360 * of_the_light.unit()).radiance()).unsqueeze(0);
  const auto count = static_cast<int>(result.regions.size()), all = static_cast<int>(materials_.size());
  const std::vector<int> chosen = draw(of_materials).different(2 * count, all);
  const auto stacked = [&](int first) {
    std::vector<at::Tensor> rows;
    for (int i = 0; i < count; ++i) rows.push_back(materials_[static_cast<std::size_t>(chosen[first + i])]);
    return at::stack(rows);
  };
  result.materials = stacked(0);
  result.targets = stacked(count);

  result.maps = maps_of(result.materials, result.radiance, settings_.map_size);
  const at::Tensor mask = (result.normals.square().sum(1, true) > 0).to(at::kFloat);
  result.image = image_of_maps(result.normals, result.regions, result.maps, settings_.map_size);
  if (settings_.targets)
    result.target =
        image_of_regions(result.normals, result.regions, result.targets, result.radiance, settings_.map_size);
  const float exposure = exposure_by_median(image_of(result.image[0]), image_of(mask[0]));
  for (at::Tensor* each : {&result.image, &result.target, &result.radiance, &result.maps}) {
    if (each->defined()) each->mul_(exposure);
  }
  result.picture = at::cat({display_values(result.image).clamp_max(1) * mask, mask}, 1);
  return result;
}

at::Tensor image_of_maps(const at::Tensor& normals, const std::vector<at::Tensor>& regions, const at::Tensor& maps,
                         int map_size) {
  at::Tensor image = at::zeros_like(normals);
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const at::Tensor map = maps.narrow(0, static_cast<std::int64_t>(i), 1);
    image = image + looked_up_images(normals * regions[i], map, map_size);
  }
  return image;
}

at::Tensor image_of_regions(const at::Tensor& normals, const std::vector<at::Tensor>& regions,
                            const at::Tensor& materials, const at::Tensor& radiance, int map_size) {
  return image_of_maps(normals, regions, maps_of(materials, radiance, map_size), map_size);
}

}  // namespace partwise::bench
