#include "partwise/normals/prediction/scene_frames.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>

#include "partwise/base/error.h"
#include "partwise/editing/editing_networks.h"
#include "partwise/editing/image_tensors.h"
#include "partwise/imaging/png.h"
#include "partwise/normals/prediction/test_rooms.h"
#include "partwise/normals/truth/depth_normals.h"
#include "partwise/normals/truth/registration.h"
#include "partwise/normals/truth/rgbd_folder.h"

namespace partwise {
namespace {

const SceneFrames& frames() {
  static const SceneFrames read({test::rooms_folder()}, 64);
  return read;
}

double largest(const at::Tensor& values) { return values.abs().max().item<double>(); }

TEST(SceneFrames, AreThePicturesAndTheNormalsOfTheirDepth) {
  ASSERT_EQ(frames().size(), 4);
  const SceneBatch batch = frames().batch(1, 0, {0, 4, 4}, false);
  ASSERT_EQ(batch.pictures.sizes(), at::IntArrayRef({4, 4, 64, 64}));  // 48 rows and 16 empty ones
  EXPECT_EQ(batch.mask().sum().item<double>(), 4 * 64 * 48);
  EXPECT_EQ(largest(batch.pictures.narrow(2, 0, 8)), 0);
  EXPECT_EQ(largest(batch.pictures.narrow(2, 56, 8)), 0);
  const std::vector<RgbdFiles> files = find_rgbd_frames(test::rooms_folder());
  for (std::int64_t i = 0; i < 4; ++i) {
    const RgbdFiles& each = files[static_cast<std::size_t>(i)];
    const at::Tensor shown = planes_of(read_plain_png(each.colour));
    EXPECT_LT(largest(batch.pictures[i].narrow(0, 0, 3).narrow(1, 8, 48) - shown), 0.06);  // sRGB and an exponent
    const RgbdFrame frame = read_registered_frame(each);
    const at::Tensor measured = planes_of(normals_from_depth(frame.depth, frame.camera));
    EXPECT_LT(largest(batch.normals[i].narrow(1, 8, 48) - measured), 0.005);
    const RoomTruth truth = read_room_truth(each.colour);
    const std::vector<int> shown_material = read_room_materials(each.colour, 64, 48);
    for (const int pixel : {0, 700, 3000}) {
      const auto material = static_cast<std::size_t>(shown_material[static_cast<std::size_t>(pixel)]);
      for (const int k : {0, 5, 31})
        EXPECT_EQ(batch.materials[i][k][8 + pixel / 64][pixel % 64].item<float>(),
                  truth.materials[material][static_cast<std::size_t>(k)]);
    }
    EXPECT_LT(largest(batch.log_radiance[i] - log_of_radiance(planes_of(truth.light))), 1e-6);
  }
}

// Mirrored, the normals' x turns over, the light's columns, and all else goes with the picture.
TEST(SceneFrames, VariedOnesAreMirroredAndBrighterAndTheSameWhenAskedAgain) {
  const SceneBatch plain = frames().batch(1, 0, {0, 4, 4}, false);
  int mirrored = 0, found = 0;
  for (std::uint64_t number = 0; number < 10; ++number) {
    const SceneBatch batch = frames().batch(1, number, {0, 4, 4}, true);
    EXPECT_TRUE(batch.pictures.equal(frames().batch(1, number, {0, 4, 4}, true).pictures));
    EXPECT_TRUE(batch.normals[2].equal(frames().batch(1, number, {2, 1, 4}, true).normals[0]));
    for (std::int64_t i = 0; i < 4; ++i) {
      for (std::int64_t k = 0; k < 4; ++k) {
        at::Tensor turned = plain.normals[k].flip({2}).clone();
        turned[0].neg_();
        const bool same = batch.normals[i].equal(plain.normals[k]), other = batch.normals[i].equal(turned);
        if (!same && !other) continue;
        ++found;
        mirrored += other ? 1 : 0;
        const auto as_seen = [&](const at::Tensor& planes) { return other ? planes.flip({2}) : planes; };
        EXPECT_TRUE(batch.materials[i].equal(as_seen(plain.materials[k])));
        const at::Tensor stops =
            (radiance_of_log(batch.log_radiance[i]) - 0.01) / (radiance_of_log(as_seen(plain.log_radiance[k])) - 0.01);
        EXPECT_GT(stops.min().item<double>(), 0.69);
        EXPECT_LT((stops / stops[0][0][0] - 1).abs().max().item<double>(), 0.02);
        break;
      }
    }
  }
  EXPECT_EQ(found, 40);
  EXPECT_GT(mirrored, 8);
  EXPECT_LT(mirrored, 32);
}

TEST(SceneFrames, LargerFramesAreReduced) {
  const SceneFrames small({test::rooms_folder()}, 32);
  const SceneBatch batch = small.batch(1, 0, {0, 2, 2}, false);
  ASSERT_EQ(batch.pictures.sizes(), at::IntArrayRef({2, 4, 32, 32}));
  const at::Tensor lengths = batch.normals.square().sum(1).sqrt();
  EXPECT_TRUE(((lengths == 0) | ((lengths - 1).abs() < 0.02)).all().item<bool>());
  EXPECT_THROW(SceneFrames({test::rooms_folder()}, 50), CheckFailed);
  EXPECT_THROW(SceneFrames({test::rooms_folder() / "color"}, 32), InputError);
}

// As frames of other data sets are: nothing is known but what was measured.
TEST(SceneFrames, WithoutTruthAreNormalsAlone) {
  const TestFolder folder;
  for (const char* each : {"color", "depth"}) std::filesystem::copy(test::rooms_folder() / each, folder.path() / each);
  std::filesystem::copy(test::rooms_folder() / "intrinsics.txt", folder.path());
  const SceneBatch batch = SceneFrames({folder.path()}, 64).batch(1, 0, {0, 4, 4}, false);
  EXPECT_TRUE(batch.normals.equal(frames().batch(1, 0, {0, 4, 4}, false).normals));
  EXPECT_EQ(largest(batch.materials_known), 0);
  EXPECT_EQ(largest(batch.light_known), 0);
}

}  // namespace
}  // namespace partwise
