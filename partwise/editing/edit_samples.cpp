#include "partwise/editing/edit_samples.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "partwise/appearance/rendering/normal_disk.h"
#include "partwise/appearance/rendering/reflectance_map.h"
#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/editing/drawn_light.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/imaging/tone_mapping.h"
#include "partwise/learning/view_warp.h"

namespace partwise {
namespace {

constexpr double exposure_stops = 0.75;

enum class Purpose : std::uint64_t { light, material, view, parts };

Draw draw_for(std::uint64_t seed, std::uint64_t batch, std::int64_t number, Purpose purpose) {
  constexpr std::uint64_t purposes = 4;
  return {seed, batch, static_cast<std::uint64_t>(number) * purposes + static_cast<std::uint64_t>(purpose)};
}

DsbrdfCoefficients drawn_material(Draw& draw, const std::vector<DsbrdfCoefficients>& materials, bool varied) {
  const auto any = [&] { return materials[static_cast<std::size_t>(draw.below(static_cast<int>(materials.size())))]; };
  DsbrdfCoefficients material = any();
  if (!varied) return material;
  if (draw.unit() < 0.5) {
    const double share = draw.unit();
    material = share * material + (1 - share) * any();
  }
  DsbrdfCoefficients result;
  const std::vector<int> order = draw.different(3, 3);
  for (int c = 0; c < 3; ++c) {
    result.segment<dsbrdf_channel_size>(c * dsbrdf_channel_size) =
        material.segment<dsbrdf_channel_size>(order[static_cast<std::size_t>(c)] * dsbrdf_channel_size);
  }
  return result;
}

EnvironmentLight light_for(Draw& draw, const std::vector<EnvironmentLight>& lights, bool varied) {
  if (varied) return drawn_light(draw, lights);
  return lights[static_cast<std::size_t>(draw.below(static_cast<int>(lights.size())))].rotated(360 * draw.unit());
}

// Three times in four.
std::optional<ViewWarp> drawn_warp(Draw& draw) {
  if (draw.unit() < 0.25) return std::nullopt;
  constexpr double turn = std::numbers::pi / 12;
  const auto stretch = [&] { return std::exp2(draw.within(-0.35, 0.35)); };
  const Eigen::Rotation2Dd along(std::numbers::pi * draw.unit());  // in which the object is stretched
  const Eigen::Vector2d both(stretch(), stretch());
  ViewWarp warp;
  warp.plane = Eigen::Rotation2Dd(draw.within(-turn, turn)) * along * both.asDiagonal() * along.inverse();
  warp.lean = {draw.within(-0.35, 0.35), draw.within(-0.35, 0.35)};
  warp.depth = stretch();
  warp.share = draw.within(0.6, 0.95);
  return warp;
}

// Of a view's parts (1 x S x S of bytes) those, chosen by chance, that wear the other material: 1 there.
at::Tensor drawn_parts(Draw draw, const at::Tensor& parts) {
  std::array<float, 256> other{};
  for (std::size_t part = 1; part < other.size(); ++part) other[part] = draw.unit() < 0.5 ? 1.0f : 0.0f;
  at::Tensor result = at::empty(parts.sizes());
  const std::uint8_t* from = parts.data_ptr<std::uint8_t>();
  std::transform(from, from + parts.numel(), result.data_ptr<float>(), [&](std::uint8_t part) { return other[part]; });
  return result;
}

// In the second map where `other` is not 0.
Image looked_up(const std::array<const ReflectanceMap*, 2>& maps, const Image& normals, const Image& other) {
  Image image(normals.width, normals.height, 3);
  for (std::size_t i = 0; i < other.values.size(); ++i) {
    const auto normal = Eigen::Map<const Eigen::Vector3f>(&normals.values[3 * i]);
    const ReflectanceMap& map = *maps[other.values[i] == 0 ? 0 : 1];
    if (!normal.isZero()) Eigen::Map<Eigen::Vector3f>(&image.values[3 * i]) = map.colour(normal);
  }
  return image;
}

}  // namespace

struct EditSamples::Group {
  std::array<DsbrdfCoefficients, 2> materials;
  at::Tensor radiance;  // 3 x 64 x 128
  std::array<std::optional<ReflectanceMap>, 2> maps;
  std::array<at::Tensor, 2> texels;  // of these, 3 x T
};

EditSamples::EditSamples(const StoredViews& views, std::vector<DsbrdfCoefficients> materials,
                         const std::vector<EnvironmentLight>& lights, const EditSamplesSettings& settings)
    : views_(views),
      materials_(std::move(materials)),
      settings_(settings),
      texels_(disk_texels(settings.map_size).index) {
  PARTWISE_CHECK(views_.size(), >, 0);
  PARTWISE_CHECK(materials_.size(), >, 0u);
  PARTWISE_CHECK(lights.size(), >, 0u);
  for (const EnvironmentLight& each : lights) lights_.push_back(each.resized(light_columns, light_rows));
}

EditSamples::Group EditSamples::group(std::uint64_t batch, std::int64_t number) const {
  Draw material = draw_for(settings_.seed, batch, number, Purpose::material);
  Draw light = draw_for(settings_.seed, batch, number, Purpose::light);
  Group result;
  for (DsbrdfCoefficients& each : result.materials) each = drawn_material(material, materials_, settings_.varied);
  const EnvironmentLight radiance = light_for(light, lights_, settings_.varied);
  result.radiance = planes_of(radiance.radiance());
  const LightSamples samples = light_samples(radiance);
  tbb::parallel_for(std::size_t(0), result.maps.size(), [&](std::size_t i) {
    result.maps[i].emplace(Dsbrdf(result.materials[i]), samples, settings_.map_size);
    const at::Tensor texels = at::empty({3, std::ssize(texels_)});
    for (std::size_t k = 0; k < texels_.size(); ++k)
      for (std::size_t c = 0; c < 3; ++c)
        texels.data_ptr<float>()[c * texels_.size() + k] =
            result.maps[i]->image().values[3 * static_cast<std::size_t>(texels_[k]) + c];
    result.texels[i] = texels;
  });
  return result;
}

EditBatch EditSamples::batch(std::uint64_t number, const Rows& rows) const {
  const std::int64_t side = views_.side();
  const auto images = [&](std::int64_t channels) { return at::zeros({rows.count, channels, side, side}); };
  const auto coefficients = [&] { return at::empty({rows.count, dsbrdf_size}); };
  EditBatch result{.pictures = images(4),
                   .normals = images(3),
                   .material = coefficients(),
                   .radiance = at::empty({rows.count, 3, light_rows, light_columns}),
                   .image = images(3),
                   .target_material = coefficients(),
                   .target = images(3),
                   .other_parts = images(1),
                   .maps = at::empty({rows.count, 2, 3, std::ssize(texels_)}),
                   .map_size = settings_.map_size};
  const std::int64_t group_rows = settings_.group;
  const std::int64_t last = rows.first + rows.count;
  tbb::parallel_for(rows.first / group_rows, (last + group_rows - 1) / group_rows, [&](std::int64_t g) {
    const at::NoGradGuard no_gradient;
    const Group shared = group(number, g);
    const std::int64_t from = std::max(rows.first, g * group_rows), to = std::min(last, (g + 1) * group_rows);
    for (std::int64_t row = from; row < to; ++row) add_row(number, row, rows.first, shared, result);
  });
  return result;
}

void EditSamples::add_row(std::uint64_t batch, std::int64_t row, std::int64_t first, const Group& group,
                          EditBatch& result) const {
  Draw draw = draw_for(settings_.seed, batch, row, Purpose::view);
  const std::int64_t view = draw.below(static_cast<int>(views_.size()));
  const bool mirrored = draw.unit() < 0.5;
  const double stops = settings_.varied ? draw.within(-exposure_stops, exposure_stops) : 0;
  const std::optional<ViewWarp> warp = settings_.varied ? drawn_warp(draw) : std::nullopt;
  at::Tensor normals = views_.normals(view, mirrored);
  if (warp) normals = warped_normals(normals, *warp);
  const at::Tensor mask = (normals.square().sum(0, true) > 0).to(at::kFloat);
  const auto worn = static_cast<std::size_t>(row % 2), wanted = 1 - worn;
  const std::int64_t at = row - first;
  if (settings_.parts > 0) {
    Draw parts = draw_for(settings_.seed, batch, row, Purpose::parts);
    if (parts.unit() < settings_.parts) {
      at::Tensor seen = views_.parts(view, mirrored);
      if (warp) seen = warped_parts(seen, *warp);
      result.other_parts[at] = drawn_parts(parts, seen.unsqueeze(0).contiguous()) * mask;
    }
  }
  const Image shape = image_of(normals), other = image_of(result.other_parts[at]);
  const std::array maps{&*group.maps[worn], &*group.maps[wanted]};
  const Image image = looked_up(maps, shape, other), target = looked_up({maps[1], maps[0]}, shape, other);
  const double exposure = exposure_by_median(image, image_of(mask)) * std::exp2(stops);
  result.image[at] = planes_of(image) * exposure;
  result.target[at] = planes_of(target) * exposure;
  result.radiance[at] = group.radiance * exposure;
  result.maps[at][0] = group.texels[worn] * exposure;
  result.maps[at][1] = group.texels[wanted] * exposure;
  result.normals[at] = normals;
  result.material[at] = as_tensor(group.materials[worn]);
  result.target_material[at] = as_tensor(group.materials[wanted]);
  result.pictures[at].narrow(0, 0, 3) = display_values(result.image[at]).clamp_max(1) * mask;
  result.pictures[at].narrow(0, 3, 1) = mask;
}

}  // namespace partwise
