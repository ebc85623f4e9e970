#include "partwise/appearance/rendering/reflectance_map.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include <numbers>

#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/appearance/rendering/test_scenes.h"
#include "partwise/base/error.h"
#include "partwise/imaging/image_metrics.h"

namespace partwise {
namespace {

RenderScene ball() {
  const RenderMesh mesh{test::sphere(60), {}, 180};
  return RenderScene({&mesh, 1});
}

Camera front() {
  Camera camera;
  camera.position = Point(0, 0, 10);
  camera.half_height = 1.3;
  camera.orthographic = true;
  return camera;
}

// A lobe cos^gamma over the half-vector is as wide in light as four times its variance 1 / gamma in half-vectors: light
// turns by twice the angle. Three pixels of 2 pi / 128 in diameter at one sigma each way: gamma = (2 / (1.5 *
// pixel))^2.
double three_pixel_gamma() { return std::pow(2 / (1.5 * 2 * std::numbers::pi / 128), 2); }

TEST(ReflectanceMap, MeetsTheExactSumWithinOneInAHundred) {
  const RenderScene scene = ball();
  const GBuffer seen = scene.view(front(), {48, 48, 1});
  for (const char* name : {"studio", "city", "sky"}) {
    const LightSamples light = light_samples(shipped_light(name).resized(128, 64));
    for (const double gamma : {10.0, 150.0, three_pixel_gamma()}) {
      const Dsbrdf material = test::glossy(1.5, gamma);
      const LightSum sum(material, light);
      const ReflectanceMap map(material, light, 64);
      const std::array sums{&sum};
      const std::array maps{&map};
      const double difference = relative_error(mapped_image(seen, maps), exact_image(seen, sums));
      EXPECT_LT(difference, 0.01) << name << " gamma " << gamma;
    }
  }
}

TEST(ReflectanceMap, TexelsAreTheExactSumsOfTheirNormals) {
  const LightSamples light = light_samples(shipped_light("lobby").resized(64, 32));
  const Dsbrdf material = test::glossy(4, 3000, -0.5);
  const LightSum sum(material, light);
  const int size = 33;
  const ReflectanceMap map(material, light, size);
  int texels = 0;
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = (column - 1) / 15.0 - 1, y = 1 - (row - 1) / 15.0, square = x * x + y * y;
      if (square > 1) continue;
      const double scale = std::sqrt(2 - square);
      const Eigen::Vector3f normal = Eigen::Vector3d(x * scale, y * scale, 1 - square).cast<float>();
      const Eigen::Vector3f exact = sum.colour(normal),
                            texel = Eigen::Map<const Eigen::Vector3f>(map.image().pixel(column, row));
      EXPECT_LT((exact - texel).norm(), 2e-3f * exact.norm()) << normal.transpose();
      EXPECT_LT((map.colour(normal) - texel).norm(), 1e-3f * exact.norm()) << normal.transpose();
      ++texels;
    }
  }
  EXPECT_GT(texels, 650);
  EXPECT_GT(map.normals(), texels);
}

TEST(ReflectanceMap, GoesOnSmoothlyAtTheRim) {  // as well as in the middle, for materials of any kind
  const LightSamples light = light_samples(shipped_light("park").resized(64, 32));
  const MicrofacetBrdf lambert = test::lambert(0.6);
  const Dsbrdf glossy = test::glossy(0.5, 30);
  for (const Brdf* material : {static_cast<const Brdf*>(&lambert), static_cast<const Brdf*>(&glossy)}) {
    const LightSum sum(*material, light);
    const ReflectanceMap map(*material, light, 64);
    const float bound = 0.02f * sum.colour({0, 0, 1}).norm();
    for (int i = 0; i < 200; ++i) {
      const float angle = 0.1f + 0.0314f * static_cast<float>(i), z = 0.004f * static_cast<float>(i % 5);
      const Eigen::Vector3f normal(std::cos(angle) * std::sqrt(1 - z * z), std::sin(angle) * std::sqrt(1 - z * z), z);
      EXPECT_LT((map.colour(normal) - sum.colour(normal)).norm(), bound) << normal.transpose();
    }
  }
}

TEST(ReflectanceMap, NormalsThatTurnAwayAreTheRims) {
  const LightSamples light = light_samples(shipped_light("park").resized(32, 16));
  const Dsbrdf material = test::glossy(0.5, 30);
  const ReflectanceMap map(material, light, 32);
  const Eigen::Vector3f away = Eigen::Vector3f(0.6f, 0.8f, -0.2f).normalized();
  EXPECT_LT((map.colour(away) - map.colour({0.6f, 0.8f, 0})).norm(), 1e-5f);
  EXPECT_TRUE(map.colour({0, 0, -1}).allFinite());
  EXPECT_THROW(ReflectanceMap(material, light, 7), CheckFailed);
}

TEST(ReflectanceMap, TheSameForAnyNumberOfThreads) {
  const LightSamples light = light_samples(shipped_light("night").resized(64, 32));
  const Dsbrdf material = test::glossy(2, 500);
  const auto make = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return ReflectanceMap(material, light, 100).image().values;  // more normals than one block
  };
  const std::vector<float> one = make(1);
  EXPECT_EQ(one, make(2));
  EXPECT_EQ(one, make(4));
}

TEST(ImageFormation, ALambertianSphereUnderAConstantSkyIsFlat) {
  const RenderScene scene = ball();
  const GBuffer seen = scene.view(front(), {64, 64, 1});
  const LightSamples light = light_samples(EnvironmentLight(Image(128, 64, 3, 1)));
  const MicrofacetBrdf half = test::lambert(0.5);
  const LightSum sum(half, light);
  const ReflectanceMap map(half, light);
  const std::array sums{&sum};
  const std::array maps{&map};
  for (const Image& image : {exact_image(seen, sums), mapped_image(seen, maps)}) {
    for (std::size_t i = 0; i < seen.parts.size(); ++i) {
      EXPECT_NEAR(image.values[3 * i], seen.parts[i] < 0 ? 0 : 0.5f, 5e-4f);
    }
  }
}

// Turning the light one way about the vertical and the camera the other way shows the same picture.
TEST(ImageFormation, RotatingTheLightIsRotatingTheScene) {
  Mesh mesh = test::sphere(40);
  mesh.vertices.col(0) *= 1.7;
  mesh.vertices.col(1) = mesh.vertices.col(1).array() + 0.2 * mesh.vertices.col(0).array().square();
  const RenderMesh each{mesh, {}, 180};
  const RenderScene scene({&each, 1});
  const EnvironmentLight light = shipped_light("hall").resized(128, 64);
  const Dsbrdf material = test::glossy(1, 60);
  const auto picture = [&](double light_degrees, double mesh_degrees, double camera_degrees) {
    const double radians = std::numbers::pi / 180;
    RenderMesh turned = each;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(mesh_degrees * radians, Eigen::Vector3d::UnitY()).toRotationMatrix();
    turned.mesh.vertices = turned.mesh.vertices * turn.transpose();
    const RenderScene turned_scene({&turned, 1});
    Camera camera;
    camera.axes = Eigen::AngleAxisd(camera_degrees * radians, Eigen::Vector3d::UnitY()).toRotationMatrix().transpose();
    camera.position = (camera.axes.transpose() * Eigen::Vector3d(0, 0, 10)).transpose();
    camera.half_height = 2.2;
    camera.orthographic = true;
    const LightSamples samples = light_samples(light.rotated(light_degrees), camera.axes);
    const LightSum sum(material, samples);
    const std::array sums{&sum};
    return exact_image(turned_scene.view(camera, {40, 40, 1}), sums);
  };
  const Image all_still = picture(0, 0, 0), all_turned = picture(45, 45, 45);  // 16 columns
  EXPECT_LT(relative_error(all_turned, all_still), 2e-3);
  EXPECT_GT(relative_error(picture(45, 0, 0), all_still), 0.05);  // the light alone does change it
}

TEST(ImageFormation, PartsWearTheirMaterialsAndSamplesAreAveraged) {
  const std::vector<RenderMesh> meshes = {{test::square(1, 0), {0, 0}, 0}, {test::square(0.5, 1), {1, 1}, 0}};
  const RenderScene scene(meshes);
  Camera camera = front();
  const GBuffer seen = scene.view(camera, {26, 26, 4});
  const LightSamples light = light_samples(EnvironmentLight(Image(32, 16, 3, 1)));
  const MicrofacetBrdf dark = test::lambert(0.2), bright = test::lambert(0.8);
  const LightSum dark_sum(dark, light), bright_sum(bright, light);
  const std::array sums{&dark_sum, &bright_sum};
  const Image image = exact_image(seen, sums), mask = seen.mask_image();
  EXPECT_NEAR(image.pixel(13, 13)[0], 0.8f, 3e-3f);
  EXPECT_NEAR(image.pixel(4, 13)[0], 0.2f, 1e-3f);
  EXPECT_EQ(image.pixel(0, 0)[0], 0);
  const std::array one{&dark_sum};
  EXPECT_THROW(exact_image(seen, one), CheckFailed);
}

// A small square right above a large one takes from the large one what it covers of the sky.
TEST(ImageFormation, ShadowsAreTheSkyThatIsCovered) {
  const std::vector<RenderMesh> meshes = {{test::square(3, 0), {}, 0}, {test::square(0.5, 1), {}, 0}};
  const RenderScene scene(meshes);
  Camera camera;
  camera.position = Point(0, 0, 0.5);  // between the two
  camera.half_height = 0.01;
  camera.orthographic = true;
  const GBuffer seen = scene.view(camera, {1, 1, 1});
  const LightSamples light = light_samples(EnvironmentLight(Image(512, 256, 3, 1)));
  const MicrofacetBrdf white = test::lambert(1);
  const LightSum sum(white, light);
  const std::array sums{&sum};
  // The form factor of a square of half side a at distance 1 above a point: 4 (2 a / (2 pi sqrt(1 + a^2))) atan(a /
  // sqrt(1 + a^2)).
  const double a = 0.5, root = std::sqrt(1 + a * a);
  const double covered = 4 / std::numbers::pi * a / root * std::atan(a / root);
  EXPECT_NEAR(shadowed_image(seen, sums, scene, camera, light).values[0], 1 - covered, 3e-3);
  EXPECT_NEAR(exact_image(seen, sums).values[0], 1, 1e-3);
}

TEST(ImageFormation, TheSameForAnyNumberOfThreads) {
  const RenderScene scene = ball();
  const auto make = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const GBuffer seen = scene.view(front(), {40, 30, 2});
    const LightSamples light = light_samples(shipped_light("night").resized(64, 32));
    const Dsbrdf material = test::glossy(2, 500);
    const LightSum sum(material, light);
    const ReflectanceMap map(material, light, 48);
    const std::array sums{&sum};
    const std::array maps{&map};
    std::vector<float> values = exact_image(seen, sums).values;
    for (const Image& image : {mapped_image(seen, maps), shadowed_image(seen, sums, scene, front(), light)}) {
      values.insert(values.end(), image.values.begin(), image.values.end());
    }
    return values;
  };
  const std::vector<float> one = make(1);
  EXPECT_EQ(one, make(2));
  EXPECT_EQ(one, make(4));
}

}  // namespace
}  // namespace partwise
