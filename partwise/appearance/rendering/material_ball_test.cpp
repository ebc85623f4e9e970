#include "partwise/appearance/rendering/material_ball.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>

#include "partwise/appearance/rendering/image_formation.h"
#include "partwise/appearance/rendering/test_scenes.h"
#include "partwise/base/error.h"
#include "partwise/imaging/tone_mapping.h"

namespace partwise {
namespace {

LightTree constant_sky(float radiance) { return LightTree(EnvironmentLight(Image(256, 128, 3, radiance))); }

TEST(BallView, IsWhatACameraSeesOfASphere) {
  const RenderMesh mesh{test::sphere(400), {}, 180};
  Camera camera;
  camera.position = Point(0, 0, 2);
  camera.orthographic = true;
  const GBuffer truth = RenderScene({&mesh, 1}).view(camera, {32, 32, 5});
  const GBuffer seen = ball_view(32, 5);
  ASSERT_EQ(seen.normals.size(), truth.normals.size());
  int other = 0;
  for (std::size_t i = 0; i < seen.parts.size(); ++i) {
    if (seen.parts[i] != truth.parts[i]) {
      ++other;  // the mesh lies inside the ball by a hair
      continue;
    }
    EXPECT_LT((seen.normals[i] - truth.normals[i]).norm(), 0.02f);
    EXPECT_NEAR(seen.depths[i], truth.depths[i], 0.005f);
  }
  EXPECT_LT(other, 4);
}

TEST(BallView, CoversADisk) {
  const GBuffer seen = ball_view(64, 16);
  EXPECT_NEAR(seen.foreground(), std::numbers::pi / 4, 1e-3);
  const Image mask = seen.mask_image();
  EXPECT_EQ(mask.pixel(32, 32)[0], 1);
  EXPECT_EQ(mask.pixel(0, 0)[0], 0);
  EXPECT_THROW(ball_view(0, 1), CheckFailed);
  EXPECT_THROW(ball_view(1, 0), CheckFailed);
}

// Radiance 2.5 from everywhere is an irradiance of 2.5 pi, of which albedo / pi comes to the viewer.
TEST(MaterialBall, ALambertianUnderAConstantSkyIsFlat) {
  const Image ball = material_ball(test::lambert(0.3), constant_sky(2.5f), 40);
  ASSERT_EQ(ball.channels, 4);
  int covered = 0;
  for (std::size_t i = 0; i < ball.values.size(); i += 4) {
    if (ball.values[i + 3] == 0) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(ball.values[i + k], 0);  // clear
      continue;
    }
    ++covered;
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(ball.values[i + k], 0.75f, 0.75e-3f);
  }
  EXPECT_GT(covered, 40 * 40 * 3 / 4);
  EXPECT_EQ(ball.pixel(0, 0)[3], 0);
  EXPECT_EQ(ball.pixel(20, 20)[3], 1);
}

// A sky that is the same left and right and above and below leaves the ball so, whatever it is made of.
TEST(MaterialBall, IsAsSymmetricAsItsLight) {
  const int size = 30;
  const Image ball = material_ball(test::glossy(2, 400), constant_sky(1), size);
  double difference = 0, sum = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (ball.pixel(x, y)[3] < 1 || ball.pixel(size - 1 - x, y)[3] < 1 || ball.pixel(x, size - 1 - y)[3] < 1) continue;
      for (int k = 0; k < 3; ++k) {
        const auto here = static_cast<double>(ball.pixel(x, y)[k]);
        sum += here;
        difference += std::abs(here - static_cast<double>(ball.pixel(size - 1 - x, y)[k]));
        difference += std::abs(here - static_cast<double>(ball.pixel(x, size - 1 - y)[k]));
      }
    }
  }
  EXPECT_LT(difference, 0.02 * sum);  // its samples are not quite as symmetric
}

TEST(MaterialBall, IsTheExactSumInItsPixels) {
  const EnvironmentLight light = shipped_light("studio").resized(128, 64);
  const Dsbrdf material = test::glossy(1.5, 150);
  const Image ball = material_ball(material, LightTree(light), 32);
  const LightSamples samples = light_samples(light);
  const LightSum sum(material, samples);
  const std::array sums{&sum};
  const Image truth = exact_image(ball_view(32, 16), sums);
  double difference = 0, whole = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    const auto found = static_cast<double>(ball.values[i / 3 * 4 + i % 3] * ball.values[i / 3 * 4 + 3]);
    difference += std::abs(found - static_cast<double>(truth.values[i]));
    whole += static_cast<double>(truth.values[i]);
  }
  EXPECT_LT(difference, 0.01 * whole);
}

TEST(MaterialBall, IsTheSameForAnyNumberOfThreads) {
  const LightTree light(shipped_light("city"));
  const Dsbrdf material = test::glossy(4, 3000);
  const Image several = material_ball(material, light, 24);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(material_ball(material, light, 24).values, several.values);
}

TEST(GreyCard, IsMiddleGrey) {
  const EnvironmentLight sky(Image(64, 32, 3, 5));
  EXPECT_NEAR(grey_card_exposure(sky), 0.2f, 1e-3f);  // a card of albedo 0.18 sends 0.18 times 5
  EXPECT_EQ(grey_card_exposure(EnvironmentLight(Image(64, 32, 3, 0))), 1);
  const EnvironmentLight light = shipped_light("park");
  const Image card = material_ball(test::lambert(0.18), LightTree(light), 24);
  Image mask(24, 24, 1);
  for (std::size_t i = 0; i < mask.values.size(); ++i) mask.values[i] = card.values[4 * i + 3];
  EXPECT_NEAR(grey_card_exposure(light), exposure_by_median(card, mask), 0.03f * grey_card_exposure(light));
}

}  // namespace
}  // namespace partwise
