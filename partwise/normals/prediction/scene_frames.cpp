#include "partwise/normals/prediction/scene_frames.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "partwise/appearance/material/dsbrdf_basis.h"
#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/picture_terms.h"
#include "partwise/learning/network_blocks.h"
#include "partwise/normals/prediction/u_network.h"
#include "partwise/normals/scenes/room_dataset.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/registration.h"
#include "partwise/normals/truth/rgbd_folder.h"

namespace partwise {
namespace {

constexpr double codes = 255, steps = 127;
constexpr double gamma = 2.2;

at::Tensor bytes(const at::Tensor& values, double largest) {
  return (values * largest).round().clamp(0, largest).to(at::kByte);
}

// Planes of a frame brought to `columns`, as their shape has it.
at::Tensor reduced(const at::Tensor& planes, std::int64_t columns) {
  const std::int64_t rows = std::lround(static_cast<double>(planes.size(1) * columns) / planes.size(2));
  return scaled(planes.unsqueeze(0), rows, columns)[0];
}

// Rows cut, or empty ones added, above and below alike.
at::Tensor with_rows(const at::Tensor& planes, std::int64_t rows) {
  const std::int64_t more = rows - planes.size(1);
  if (more <= 0) return planes.narrow(1, -more / 2, rows).contiguous();
  return at::constant_pad_nd(planes, {0, 0, more / 2, more - more / 2});
}

// Of the depth's normals, where half of a pixel or more has one.
at::Tensor reduced_normals(const Image& normals, std::int64_t columns) {
  const at::Tensor whole = planes_of(normals);
  const at::Tensor known = reduced((whole.square().sum(0, true) > 0).to(at::kFloat), columns);
  return unit_vectors(reduced(whole, columns).unsqueeze(0))[0] * (known >= 0.5f);
}

}  // namespace

SceneFrames::SceneFrames(const std::vector<std::filesystem::path>& folders, int width, const Progress& progress)
    : width_(width), height_(static_cast<int>(whole_blocks(3 * width / 4))) {
  PARTWISE_CHECK(whole_blocks(width), ==, width);
  std::vector<RgbdFiles> files;
  for (const auto& folder : folders) std::ranges::copy(find_rgbd_frames(folder), std::back_inserter(files));
  frames_.resize(files.size());
  constexpr std::size_t slice = 32;
  for (std::size_t first = 0; first < files.size(); first += slice) {
    progress("frames", static_cast<double>(first) / static_cast<double>(files.size()));
    tbb::parallel_for(first, std::min(first + slice, files.size()), [&](std::size_t i) {
      const at::NoGradGuard no_gradient;
      frames_[i] = read(files[i].colour, read_registered_frame(files[i]));
    });
  }
}

SceneFrames::Frame SceneFrames::read(const std::filesystem::path& colour, const RgbdFrame& frame) const {
  Frame result;
  const at::Tensor shown = display_values(reduced(planes_of(frame.colour), width_));
  result.colours = bytes(with_rows(shown, height_), codes);
  result.mask = with_rows(at::ones({1, shown.size(1), width_}, at::kByte), height_);
  const at::Tensor normals = reduced_normals(normals_from_depth(frame.depth, frame.camera), width_);
  result.normals = (with_rows(normals, height_) * steps).round().to(at::kChar);
  if (!has_room_truth(colour)) return result;

  const RoomTruth truth = read_room_truth(colour);
  const std::vector<int> seen = read_room_materials(colour, frame.depth.width, frame.depth.height);
  // A pixel shows one material or the other: of larger pictures, that of each pixel's middle.
  at::Tensor which = at::empty({1, shown.size(1), width_}, at::kByte);
  const double scale = static_cast<double>(frame.depth.width) / width_;
  for (std::int64_t y = 0; y < which.size(1); ++y) {
    for (std::int64_t x = 0; x < width_; ++x) {
      const auto row = std::min(static_cast<int>((y + 0.5) * scale), frame.depth.height - 1),
                 column = std::min(static_cast<int>((x + 0.5) * scale), frame.depth.width - 1);
      const int material = seen[static_cast<std::size_t>(row * frame.depth.width + column)];
      const bool known = material >= 0 && material < static_cast<int>(truth.materials.size());
      which.data_ptr<std::uint8_t>()[y * width_ + x] = static_cast<std::uint8_t>(known ? material + 1 : 0);
    }
  }
  result.which = with_rows(which, height_)[0];
  result.materials = at::zeros({std::ssize(truth.materials) + 1, default_components});
  for (std::size_t i = 0; i < truth.materials.size(); ++i)
    std::ranges::copy(truth.materials[i],
                      result.materials.data_ptr<float>() + (static_cast<std::int64_t>(i) + 1) * default_components);
  result.radiance = planes_of(truth.light);
  return result;
}

SceneBatch SceneFrames::batch(std::uint64_t seed, std::uint64_t number, const Rows& rows, bool varied) const {
  PARTWISE_CHECK(size(), >, 0);
  SceneBatch result;
  const std::int64_t count = rows.count;
  result.pictures = at::zeros({count, 4, height_, width_});
  result.normals = at::zeros({count, 3, height_, width_});
  result.materials = at::zeros({count, default_components, height_, width_});
  result.materials_known = at::zeros({count, 1, height_, width_});
  result.log_radiance = at::zeros({count, 3, RoomTruth::light_rows, RoomTruth::light_columns});
  result.light_known = at::zeros({count, 1, 1, 1});
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t row = rows.first + i;
    Draw draw(seed, number, static_cast<std::uint64_t>(row));
    const std::int64_t in_turn = (static_cast<std::int64_t>(number) * rows.all + row) % size();
    const Frame& frame = frames_[static_cast<std::size_t>(varied ? draw.below(static_cast<int>(size())) : in_turn)];
    const bool mirrored = varied && draw.unit() < 0.5;
    const double factor = varied ? std::exp2(draw.within(-0.5, 0.5)) : 1;
    const auto turned = [&](const at::Tensor& planes) { return mirrored ? planes.flip({planes.dim() - 1}) : planes; };

    const at::Tensor mask = turned(frame.mask).to(at::kFloat);
    const at::Tensor colours = turned(frame.colours).to(at::kFloat) / codes * std::pow(factor, 1 / gamma);
    result.pictures[i].copy_(at::cat({colours.clamp_max(1) * mask, mask}));
    at::Tensor normals = turned(frame.normals).to(at::kFloat) / steps;
    if (mirrored) normals[0].neg_();
    result.normals[i].copy_(normals);
    if (!frame.radiance.defined()) continue;
    const at::Tensor which = turned(frame.which).to(at::kLong);
    result.materials[i].copy_(frame.materials.index_select(0, which.flatten()).t().reshape({-1, height_, width_}));
    result.materials_known[i][0].copy_(which > 0);
    result.log_radiance[i].copy_(log_of_radiance(turned(frame.radiance) * factor));
    result.light_known[i].fill_(1);
  }
  return result;
}

}  // namespace partwise
