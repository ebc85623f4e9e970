#include "partwise/appearance/rendering/light_tree.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <random>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/appearance/rendering/test_scenes.h"
#include "partwise/base/error.h"

namespace partwise {
namespace {

std::vector<Eigen::Vector3f> normals_of_a_ball(int size) {
  std::vector<Eigen::Vector3f> normals = ball_view(size, 1).normals;
  std::erase_if(normals, [](const Eigen::Vector3f& normal) { return normal.isZero(); });
  return normals;
}

// The sum of differences over the sum of values.
double relative_difference(const std::vector<Eigen::Vector3f>& found, const std::vector<Eigen::Vector3f>& truth) {
  double difference = 0, sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    difference += static_cast<double>((found[i] - truth[i]).cwiseAbs().sum());
    sum += static_cast<double>(truth[i].sum());
  }
  return difference / sum;
}

TEST(LightTree, PatchesBringWhatTheirPixelsDo) {
  for (const auto& [width, height] : {std::pair{512, 256}, {96, 41}, {7, 3}, {1, 1}}) {
    const EnvironmentLight light = shipped_light("sunrise").resized(width, height);
    const LightTree tree(light);
    const std::vector<LightPatch>& patches = tree.patches();
    Eigen::Vector3d all = Eigen::Vector3d::Zero(), of_pixels = Eigen::Vector3d::Zero();
    for (int i = 0; i < tree.largest(); ++i) all += patches[static_cast<std::size_t>(i)].radiance.cast<double>();
    for (const LightPatch& patch : patches) {
      EXPECT_NEAR(patch.direction.norm(), 1, 1e-5);
      if (patch.children == 0) {
        of_pixels += patch.radiance.cast<double>();
        EXPECT_EQ(patch.spread, 0);
        continue;
      }
      Eigen::Vector3d children = Eigen::Vector3d::Zero();
      for (int k = 0; k < patch.children; ++k)
        children += patches[static_cast<std::size_t>(patch.first + k)].radiance.cast<double>();
      EXPECT_LT((children - patch.radiance.cast<double>()).norm(), 1e-5 * children.norm());
    }
    EXPECT_LT((all - light.energy()).norm(), 1e-5 * all.norm());
    EXPECT_LT((of_pixels - light.energy()).norm(), 1e-5 * all.norm());
  }
}

TEST(LightTree, ASpreadIsTheRootMeanSquareDistance) {
  Image map(2, 2, 3);  // two pixels of the upper row, three parts of the light in one of them
  std::fill_n(map.pixel(0, 0), 3, 1.0f);
  std::fill_n(map.pixel(1, 0), 3, 3.0f);
  Image tall(2, 16, 3);  // a patch at the top is two rows of this one
  for (int x = 0; x < 2; ++x) std::copy_n(map.pixel(x, 0), 3, tall.pixel(x, 4));
  const EnvironmentLight light(tall);
  const LightTree tree(light);
  ASSERT_EQ(tree.largest(), 1);
  const Eigen::Vector3d a = light.direction(0, 4).cast<double>(), b = light.direction(1, 4).cast<double>();
  const Eigen::Vector3d mean = (a + 3 * b).normalized();
  EXPECT_LT((tree.patches()[0].direction.cast<double>() - mean).norm(), 1e-6);
  const double square = ((a - mean).squaredNorm() + 3 * (b - mean).squaredNorm()) / 4;
  EXPECT_NEAR(static_cast<double>(tree.patches()[0].spread), std::sqrt(square), 1e-6);
}

TEST(PatchSum, OfNoPatchesIsTheExactSum) {
  const EnvironmentLight light = shipped_light("studio").resized(64, 32);
  const LightTree tree(light);
  const LightSamples samples = light_samples(light);
  const std::vector<Eigen::Vector3f> normals = normals_of_a_ball(12);
  for (const auto& [kappa, gamma, first] : {std::tuple(0.5, 20.0, 0.3), {3.0, 900.0, -1.5}, {6.0, 40000.0, 4.0}}) {
    const Dsbrdf material = test::glossy(kappa, gamma, first);
    EXPECT_LT(
        relative_difference(PatchSum(material, tree, 0).colours(normals), LightSum(material, samples).colours(normals)),
        0.003)
        << gamma;
  }
  const MicrofacetBrdf matt = test::lambert(0.7);
  EXPECT_LT(relative_difference(PatchSum(matt, tree, 0).colours(normals), LightSum(matt, samples).colours(normals)),
            1e-5);
}

TEST(PatchSum, MeetsTheExactSumWithinOneInAHundred) {
  const std::vector<Eigen::Vector3f> normals = normals_of_a_ball(10);
  for (const char* place : {"studio", "sunrise"}) {
    const EnvironmentLight light = shipped_light(place).resized(256, 128);
    const LightTree tree(light);
    const LightSamples samples = light_samples(light);
    for (const char* name : {"chrome", "gold-paint", "red-fabric", "black-obsidian", "pearl-paint", "white-marble"}) {
      const Dsbrdf material = shipped_material(name).brdf;
      const double difference =
          relative_difference(PatchSum(material, tree).colours(normals), LightSum(material, samples).colours(normals));
      EXPECT_LT(difference, 0.01) << name << " in " << place;
    }
  }
}

TEST(PatchSum, TurnsWithItsLight) {
  const EnvironmentLight light = shipped_light("lobby").resized(128, 64);
  const Eigen::Matrix3d quarter = Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const LightTree turned(light, quarter), rotated(light.rotated(90));
  const Dsbrdf material = test::glossy(2, 500);
  const std::vector<Eigen::Vector3f> normals = normals_of_a_ball(12);
  EXPECT_LT(
      relative_difference(PatchSum(material, turned).colours(normals), PatchSum(material, rotated).colours(normals)),
      1e-3);
  EXPECT_THROW(PatchSum(material, turned, -1), CheckFailed);
}

}  // namespace
}  // namespace partwise
