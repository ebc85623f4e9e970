#include "partwise/appearance/rendering/g_buffer.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include <filesystem>
#include <numbers>

#include "partwise/appearance/rendering/test_scenes.h"
#include "partwise/base/error.h"
#include "partwise/imaging/png.h"

namespace partwise {
namespace {

Camera front(double half_height, bool orthographic = true) {
  Camera camera;
  camera.position = Point(0, 0, 10);
  camera.half_height = half_height;
  camera.orthographic = orthographic;
  return camera;
}

RenderScene scene_of(const Mesh& mesh, double crease = 180) {
  const RenderMesh each{mesh, {}, crease};
  return RenderScene({&each, 1});
}

TEST(GBuffer, ASpheresNormalsAndDepthsAreItsOwn) {
  const RenderScene scene = scene_of(test::sphere(120));
  const int n = 65;
  const GBuffer seen = scene.view(front(1.25), {n, n, 1});
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const double px = 1.25 * ((2 * x + 1.0) / n - 1), py = 1.25 * (1 - (2 * y + 1.0) / n), square = px * px + py * py;
      const auto i = static_cast<std::size_t>(y * n + x);
      if (square > 1.001) {
        EXPECT_EQ(seen.parts[i], -1);
        EXPECT_EQ(seen.normals[i].norm(), 0);
        EXPECT_EQ(seen.depths[i], 0);
      } else if (square < 0.95) {
        const double pz = std::sqrt(1 - square);
        EXPECT_LT((seen.normals[i].cast<double>() - Eigen::Vector3d(px, py, pz)).norm(), 5e-3);
        EXPECT_NEAR(static_cast<double>(seen.depths[i]), 10 - pz, 3e-3);
        EXPECT_NEAR(seen.normals[i].norm(), 1, 1e-6);
      }
    }
  }
  EXPECT_NEAR(seen.foreground(), std::numbers::pi / 4 / (1.25 * 1.25), 0.01);
}

// As the file has it, right is red and up is green.
TEST(GBuffer, ASpheresNormalsAreThoseOfTheGoldenFile) {
  const Image golden = read_plain_png(std::filesystem::path(PARTWISE_TEST_DATA) / "data/golden/sphere_normals.png");
  EXPECT_GT(golden.pixel(42, 24)[0], 0.9f);
  EXPECT_GT(golden.pixel(24, 6)[1], 0.9f);
  EXPECT_EQ(golden.pixel(24, 24)[2], 1);
  const Image found = scene_of(test::sphere(160)).view(front(1.25), {49, 49, 1}).normal_image();
  int compared = 0;
  for (std::size_t i = 0; i < golden.values.size(); i += 3) {
    const bool rim = golden.values[i + 2] > 0.5001f && golden.values[i + 2] < 0.6f;
    for (std::size_t k = i; k < i + 3 && !rim; ++k, ++compared) {
      const float stored = (found.values[k] + 1) / 2;
      if (golden.values[i + 2] < 0.5001f && found.values[i + 2] != 0) continue;  // a pixel that only just misses
      EXPECT_NEAR(stored, golden.values[k], 4e-3f) << i / 3;
    }
  }
  EXPECT_GT(compared, 6000);
}

TEST(GBuffer, NormalsTurnWithTheCamera) {  // right of the picture is +x, whichever way one looks
  const RenderScene scene = scene_of(test::sphere(60));
  Camera camera = front(1.25);
  const Image straight = scene.view(camera, {33, 33, 1}).normal_image();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  camera.axes = camera.axes * turn.transpose();
  camera.position = (turn * camera.position.transpose()).transpose();
  const Image turned = scene.view(camera, {33, 33, 1}).normal_image();
  int compared = 0;
  for (std::size_t i = 0; i < straight.values.size(); i += 3) {
    if (straight.values[i + 2] < 0.3f) continue;
    ++compared;
    for (std::size_t k = i; k < i + 3; ++k) EXPECT_NEAR(turned.values[k], straight.values[k], 0.01f);
  }
  EXPECT_GT(compared, 300);
}

TEST(GBuffer, APerspectiveSphereCoversWhatItsConeDoes) {
  const RenderScene scene = scene_of(test::sphere(120));
  const double tangent = 0.15;  // half the frame; the sphere's outline has the tangent 1 / sqrt(99)
  EXPECT_NEAR(scene.view(front(tangent, false), {80, 80, 4}).foreground(),
              std::numbers::pi / 99 / (4 * tangent * tangent), 2e-3);
}

TEST(GBuffer, DepthIsAlongTheViewInPerspectiveToo) {
  const RenderScene scene = scene_of(test::square(5, 2));
  const GBuffer seen = scene.view(front(0.3, false), {40, 40, 1});
  for (const float depth : seen.depths) EXPECT_NEAR(depth, 8, 1e-4f);
}

TEST(GBuffer, FlatFacesHaveOneNormalAndBothSidesFaceTheViewer) {
  Mesh mesh = test::square(1, 0);
  mesh.faces.col(1).swap(mesh.faces.col(2));  // seen from behind
  const GBuffer seen = scene_of(mesh, 0).view(front(0.9), {16, 16, 1});
  for (const Eigen::Vector3f& normal : seen.normals) EXPECT_LT((normal - Eigen::Vector3f::UnitZ()).norm(), 1e-6f);
}

TEST(GBuffer, TheNearerPartIsSeenAndMasksAreSharesOfPixels) {
  const std::vector<RenderMesh> meshes = {{test::square(1, 0), {3, 3}, 0}, {test::square(0.5, 1), {1, 1}, 0}};
  const RenderScene scene(meshes);
  EXPECT_EQ(scene.parts(), 4);
  const int n = 32;
  const GBuffer seen = scene.view(front(1.0625), {n, n, 16});  // the large square ends in the middle of a pixel
  const std::vector<int> parts = seen.part_of_pixels();
  const Image mask = seen.mask_image(), depth = seen.depth_image();
  EXPECT_EQ(parts[n / 2 * n + n / 2], 1);
  EXPECT_FLOAT_EQ(depth.pixel(n / 2, n / 2)[0], 9);
  EXPECT_EQ(parts[n / 2 * n + 3], 3);
  EXPECT_FLOAT_EQ(depth.pixel(3, n / 2)[0], 10);
  EXPECT_EQ(mask.pixel(5, 5)[0], 1);
  const double covered = 1 / (1.0625 * 1.0625);
  EXPECT_NEAR(seen.foreground(), covered, 0.02);
  double sum = 0;
  for (const float value : mask.values) sum += static_cast<double>(value);
  EXPECT_NEAR(sum / (n * n), seen.foreground(), 1e-6);
}

TEST(GBuffer, TheSameForAnyNumberOfThreads) {
  const RenderScene scene = scene_of(test::sphere(40));
  const auto view = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return scene.view(front(1.1), {61, 47, 3});
  };
  const GBuffer one = view(1);
  for (const std::size_t threads : {2, 4}) {
    const GBuffer more = view(threads);
    EXPECT_EQ(one.normals, more.normals);
    EXPECT_EQ(one.depths, more.depths);
    EXPECT_EQ(one.parts, more.parts);
  }
}

TEST(FrameShare, CoversTheShareThatIsAskedForOrTouchesTheFrame) {
  const RenderScene round = scene_of(test::sphere(30));
  for (const double field_of_view : {0.0, 35.0}) {
    const Camera camera = frame_share(round, {20, 30, field_of_view, 0.45}, 1);
    EXPECT_NEAR(round.view(camera, {128, 128, 4}).foreground(), 0.45, 0.01);
  }
  Mesh rod = test::sphere(30);
  rod.vertices.col(0) *= 20;
  const RenderScene thin = scene_of(rod);
  const GBuffer seen = thin.view(frame_share(thin, {0, 0, 0, 0.45}, 1), {200, 200, 1});
  EXPECT_NEAR(seen.foreground(), std::numbers::pi / 4 * 0.96 * 0.96 / 20, 0.003);
}

TEST(RenderScene, RefusesWhatDoesNotFit) {
  const RenderMesh wrong{test::square(1, 0), {1}, 0};
  EXPECT_THROW(RenderScene({&wrong, 1}), CheckFailed);
  EXPECT_THROW(RenderScene({}), CheckFailed);
}

}  // namespace
}  // namespace partwise
