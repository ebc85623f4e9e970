#include "partwise/normals/prediction/photo_normals.h"

#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/nn/module.h>
#include <torch/utils.h>

#include <cmath>
#include <tuple>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/shared_files.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/editing/test_editing.h"
#include "partwise/normals/prediction/test_rooms.h"
#include "partwise/normals/truth/normal_files.h"
#include "partwise/normals/truth/normal_measures.h"
#include "partwise/normals/truth/rgbd_folder.h"

namespace partwise {
namespace {

NormalPredictor network() {
  torch::manual_seed(1);
  NormalPredictor predictor(NormalPredictorSettings{});
  predictor.module().eval();
  return predictor;
}

// A disc of a radius on a photo, its right half brighter, and a line of one pixel off it.
Photo disc(int width, int height, int radius) {
  Photo photo{Image(width, height, 3, 0.8f), {Image(width, height, 1)}, Image(width, height, 1, 1)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool line = y == height / 2 && x < width - 2;
      if (!line && std::hypot(x - width / 2, y - height / 2) > radius) continue;
      *photo.regions[0].pixel(x, y) = 1;
      photo.shown.pixel(x, y)[0] = x > width / 2 ? 0.9f : 0.3f;
    }
  }
  return photo;
}

TEST(PhotoNormals, EveryPixelOfTheObjectHasOneAndNoOther) {
  const NormalPredictor predictor = network();
  for (const auto& [width, height, radius] : {std::tuple{40, 30, 10}, {300, 200, 60}, {200, 700, 80}}) {
    const Photo photo = disc(width, height, radius);
    const Image normals = photo_normals(predictor, photo);
    ASSERT_EQ(normals.width, width);
    ASSERT_EQ(normals.height, height);
    for (std::size_t i = 0; i < photo.alpha.values.size(); ++i) {
      const float* n = &normals.values[3 * i];
      ASSERT_NEAR(std::hypot(n[0], n[1], n[2]), photo.regions[0].values[i], 1e-5) << "pixel " << i;
    }
  }
}

// A photo that is the network's picture already: what the network finds, pixel by pixel.
TEST(PhotoNormals, AreThoseOfTheNetwork) {
  const NormalPredictor predictor = network();
  constexpr int radius = 51;
  Photo photo = disc(128, 128, radius);
  for (int x = 0; x < 128; ++x) {  // no line
    if (std::abs(x - 64) > radius) *photo.regions[0].pixel(x, 64) = 0;
  }
  const Crop crop = crop_of(photo);
  ASSERT_EQ(crop.side, 128);
  ASSERT_EQ(crop.x, 0);
  ASSERT_EQ(crop.y, 0);
  const at::NoGradGuard no_gradient;
  const at::Tensor mask = planes_of(photo.regions[0]).unsqueeze(0);
  const at::Tensor found = predictor.both_ways(at::cat({planes_of(photo.shown).unsqueeze(0) * mask, mask}, 1));
  EXPECT_LT((planes_of(photo_normals(predictor, photo)) - found[0]).abs().max().item<double>(), 1e-5);
}

// A picture that is as large as the network's: what it finds, with empty rows about it.
TEST(SceneNormals, AreThoseOfTheNetwork) {
  torch::manual_seed(1);
  const NormalPredictor predictor(NormalPredictorSettings{.size = 96});
  predictor.module().eval();
  Image shown(96, 72, 3);
  for (std::size_t i = 0; i < shown.values.size(); ++i) shown.values[i] = static_cast<float>(i * 7 % 31) / 31;
  const at::NoGradGuard no_gradient;
  const at::Tensor picture = at::cat({planes_of(shown), at::ones({1, 72, 96})}).unsqueeze(0);
  const at::Tensor found = predictor.both_ways(at::constant_pad_nd(picture, {0, 0, 12, 12})).narrow(2, 12, 72);
  EXPECT_LT((planes_of(scene_normals(predictor, shown)) - found[0]).abs().max().item<double>(), 1e-5);
}

TEST(SceneNormals, OfAnySizeAreUnitVectors) {
  const NormalPredictor predictor = network();
  for (const auto& [width, height] : {std::pair{40, 30}, {333, 250}, {90, 400}, {1, 7}}) {
    const Image normals = scene_normals(predictor, Image(width, height, 3, 0.4f));
    ASSERT_EQ(normals.width, width);
    ASSERT_EQ(normals.height, height);
    for (std::size_t i = 0; i < normals.values.size(); i += 3)
      ASSERT_NEAR(std::hypot(normals.values[i], normals.values[i + 1], normals.values[i + 2]), 1, 1e-4);
  }
  EXPECT_THROW(scene_normals(predictor, Image(8, 8, 1)), CheckFailed);
  const NormalPredictor square(
      NormalPredictorSettings{.architecture = NormalArchitecture::multi_branch, .channels = 32});
  EXPECT_THROW(scene_normals(square, Image(8, 8, 3)), CheckFailed);
}

// Rooms with a chair: floors from walls, left from right; and they are small.
TEST(SceneNormals, OfWhatShipsFaceTheWayTheRoomDoes) {
  std::uintmax_t bytes = 0;
  for (const char* name : {"models/networks/scenes.pt", "models/networks/scenes_standalone.pt"}) {
    bytes += std::filesystem::file_size(shared_file(name));
    const NormalPredictor predictor = read_scene_predictor(shared_file(name));
    NormalMeasure measure;
    for (const RgbdFiles& each : find_rgbd_frames(test::rooms_folder()))
      measure.add(scene_normals(predictor, read_shown(each.colour)), read_normals(room_normals_file(each.colour)));
    EXPECT_GT(measure.errors().cosine, 0.7) << name;
  }
  EXPECT_LT(bytes, 8'000'000u);
  EXPECT_THROW(read_scene_predictor(shared_file("models/networks/editing.pt")), InputError);
}

// Pictures of shipped models: what ships tells left from right and up from down.
TEST(PhotoNormals, OfWhatShipsFaceTheWayTheSurfaceDoes) {
  const NormalPredictor predictor = read_normal_predictor(shared_file("models/networks/objects.pt"));
  const EditBatch batch = test::samples(false).batch(0, {0, 4, 4});
  const at::NoGradGuard no_gradient;
  const double cosine = ((predictor(batch.pictures) * batch.normals).sum() / batch.mask().sum()).item<double>();
  EXPECT_GT(cosine, 0.75);
}

}  // namespace
}  // namespace partwise
