#include "partwise/learning/differentiable_sum.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/base/error.h"
#include "partwise/learning/test_learning.h"

namespace partwise {
namespace {

using test::random_material, test::random_normals, test::random_radiance;

Dsbrdf dsbrdf(const Coefficients<double>& material) { return Dsbrdf(material.matrix()); }

EnvironmentLight light_of(const Planes<double>& radiance, int height, int width) {
  Image image(width, height, 3);
  for (Eigen::Index i = 0; i < radiance.rows(); ++i) {
    for (int k = 0; k < 3; ++k) image.values[static_cast<std::size_t>(3 * i + k)] = static_cast<float>(radiance(i, k));
  }
  return EnvironmentLight(std::move(image));
}

// A third lobe as sharp as those of polished metal.
Coefficients<double> sharpened(Coefficients<double> material) {
  for (int channel = 0; channel < 3; ++channel) {
    material.segment<spline_size>(channel * dsbrdf_channel_size + curve_offset(2, DsbrdfCurve::gamma))
        .setConstant(std::log(4e4));
  }
  return material;
}

TEST(DifferentiableSum, FloatsGiveTheColoursOfTheLightSum) {
  std::mt19937 random(1);
  const int height = 32, width = 64;
  const auto grid = light_grid<float>(height, width);
  const Planes<double> radiance = random_radiance(random, height * width), normals = random_normals(random, 203);
  const LightSamples samples = light_samples(light_of(radiance, height, width));
  for (const Coefficients<double>& material :
       {random_material(random, false), random_material(random, true), sharpened(random_material(random, false))}) {
    const Planes<float> colours =
        DifferentiableSum<float>(grid, material.cast<float>(), radiance.cast<float>()).colours(normals.cast<float>());
    const Dsbrdf brdf = dsbrdf(material);
    const LightSum sum(brdf, samples);
    EXPECT_TRUE((colours.row(0) == 0).all());
    for (Eigen::Index i = 1; i < normals.rows(); ++i) {
      const Eigen::Vector3f expected = sum.colour(normals.row(i).cast<float>().transpose());
      EXPECT_LT((colours.row(i).matrix().transpose() - expected).norm(), 1e-4f * expected.norm()) << normals.row(i);
    }
  }
}

TEST(DifferentiableSum, DoublesAreTheSumOfTheFormula) {
  std::mt19937 random(2);
  const int height = 6, width = 12;
  const auto grid = light_grid<double>(height, width);
  const Planes<double> radiance = random_radiance(random, height * width), normals = random_normals(random, 20);
  for (const bool cloth : {false, true}) {
    const Coefficients<double> material = random_material(random, cloth);
    const Planes<double> colours = DifferentiableSum<double>(grid, material, radiance).colours(normals);
    const Dsbrdf brdf = dsbrdf(material);
    for (Eigen::Index i = 0; i < normals.rows(); ++i) {
      const Eigen::Vector3d normal = normals.row(i).matrix().transpose();
      Eigen::Vector3d expected = Eigen::Vector3d::Zero();
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const Eigen::Vector3d to_light = equirectangular_direction(x, y, width, height);
          const Eigen::Vector3d half = (to_light + Eigen::Vector3d::UnitZ()).normalized();
          const Eigen::Vector3d value = brdf.lobes(std::acos(half.z())).value(normal.dot(half));
          expected += value.cwiseProduct(radiance.row(y * width + x).matrix().transpose()) *
                      std::max(0.0, normal.dot(to_light)) * equirectangular_solid_angle(y, width, height);
        }
      }
      EXPECT_LT((colours.row(i).matrix().transpose() - expected).norm(), 1e-11 * (1e-9 + expected.norm())) << i;
    }
  }
}

TEST(DifferentiableSum, GradientsMeetFiniteDifferences) {
  const auto grid = light_grid<double>(6, 12);
  for (const bool cloth : {false, true}) {
    std::mt19937 random(cloth ? 3 : 4);
    Coefficients<double> material = random_material(random, cloth);
    Planes<double> radiance = random_radiance(random, 72), normals = random_normals(random, 16);
    radiance.row(5) = -radiance.row(5);
    const Planes<double> factors = random_radiance(random, 16) - 0.7;
    const auto loss = [&] {
      return (factors * DifferentiableSum<double>(grid, material, radiance).colours(normals)).sum();
    };
    const auto gradient = DifferentiableSum<double>(grid, material, radiance).gradient(normals, factors);
    EXPECT_TRUE((gradient.normals.row(0) == 0).all());
    test::expect_gradient(material, gradient.material, loss);
    test::expect_gradient(radiance, gradient.radiance, loss);
    Planes<double> seen = normals.bottomRows(15);  // a background pixel is not where it may be moved
    const Planes<double> of_seen = gradient.normals.bottomRows(15), their_factors = factors.bottomRows(15);
    test::expect_gradient(seen, of_seen, [&] {
      return (their_factors * DifferentiableSum<double>(grid, material, radiance).colours(seen)).sum();
    });
  }
}

TEST(DifferentiableSum, BeyondTheBoundOfTheExponentNothingChanges) {
  const auto grid = light_grid<double>(4, 8);
  std::mt19937 random(5);
  Coefficients<double> material = random_material(random, false);
  material.head<spline_size>().setConstant(4);                    // first lobe, red: kappa = 54, cut at 12
  material.segment<spline_size>(spline_size).setConstant(0.001);  // and broad, so that it is so everywhere
  const Planes<double> radiance = random_radiance(random, 32), normals = random_normals(random, 9);
  const Planes<double> ones = Planes<double>::Ones(9, 3);
  const auto gradient = DifferentiableSum<double>(grid, material, radiance).gradient(normals, ones);
  EXPECT_TRUE((gradient.material.head<2 * spline_size>() == 0).all());
  EXPECT_TRUE((gradient.material.segment<2 * spline_size>(2 * spline_size) != 0).any());
}

// Within what floats can give; light blocks, lanes that are not filled and weak lobes that are left out are in it.
TEST(DifferentiableSum, FloatsAgreeWithDoubles) {
  std::mt19937 random(6);
  const Planes<double> radiance = random_radiance(random, 24 * 48), normals = random_normals(random, 301);
  const Planes<double> factors = random_radiance(random, 301) - 0.5;
  const auto grid = light_grid<double>(24, 48);
  const auto float_grid = light_grid<float>(24, 48);
  for (const bool cloth : {false, true}) {
    const Coefficients<double> material = random_material(random, cloth);
    const auto expected = DifferentiableSum<double>(grid, material, radiance).gradient(normals, factors);
    const auto found = DifferentiableSum<float>(float_grid, material.cast<float>(), radiance.cast<float>())
                           .gradient(normals.cast<float>(), factors.cast<float>());
    const auto close = [](const auto& a, const auto& b) {
      return (a.template cast<double>() - b).matrix().norm() / b.matrix().norm();
    };
    EXPECT_LT(close(found.normals, expected.normals), 1e-4);
    EXPECT_LT(close(found.material, expected.material), 1e-4);
    EXPECT_LT(close(found.radiance, expected.radiance), 1e-4);
  }
}

TEST(DifferentiableSum, TheSameBitsForAnyNumberOfThreads) {
  std::mt19937 random(7);
  const Planes<float> radiance = random_radiance(random, 28 * 56).cast<float>();
  const Planes<float> normals = random_normals(random, 5003).cast<float>();
  const Coefficients<float> material = random_material(random, true).cast<float>();
  const auto grid = light_grid<float>(28, 56);
  const auto results = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const DifferentiableSum<float> sum(grid, material, radiance);
    const Planes<float> colours = sum.colours(normals);
    return std::pair(colours, sum.gradient(normals, colours - 1));
  };
  const auto [one_colours, one] = results(1);
  const auto [colours, many] = results(4);
  EXPECT_TRUE((colours == one_colours).all());
  EXPECT_TRUE((many.normals == one.normals).all());
  EXPECT_TRUE((many.material == one.material).all());
  EXPECT_TRUE((many.radiance == one.radiance).all());
}

TEST(DifferentiableSum, OnlyWhatIsWantedIsGiven) {
  std::mt19937 random(8);
  const auto grid = light_grid<float>(4, 8);
  const Planes<float> radiance = random_radiance(random, 32).cast<float>();
  const Planes<float> normals = random_normals(random, 9).cast<float>();
  const DifferentiableSum<float> sum(grid, random_material(random, false).cast<float>(), radiance);
  const Planes<float> ones = Planes<float>::Ones(9, 3);
  const auto all = sum.gradient(normals, ones);
  const auto of_normals = sum.gradient(normals, ones, {true, false, false});
  EXPECT_TRUE((of_normals.normals == all.normals).all());
  EXPECT_TRUE((of_normals.material == 0).all());
  EXPECT_EQ(of_normals.radiance.size(), 0);
  const auto of_material = sum.gradient(normals, ones, {false, true, false});
  EXPECT_TRUE((of_material.material == all.material).all());
  EXPECT_EQ(of_material.normals.size(), 0);
  const auto of_radiance = sum.gradient(normals, ones, {false, false, true});
  EXPECT_TRUE((of_radiance.radiance == all.radiance).all());
}

TEST(DifferentiableSum, StaysFiniteWhereverAnOptimiserMayStray) {
  std::mt19937 random(9);
  const auto grid = light_grid<float>(8, 16);
  const Planes<float> radiance = random_radiance(random, 128).cast<float>();
  const Planes<float> normals = random_normals(random, 33).cast<float>();
  const Planes<float> ones = Planes<float>::Ones(33, 3);
  for (const float size : {30.0f, 300.0f, -300.0f}) {
    const DifferentiableSum<float> sum(grid, random_material(random, true).cast<float>() * size, radiance);
    EXPECT_TRUE(sum.colours(normals).allFinite()) << size;
    const auto gradient = sum.gradient(normals, ones);
    EXPECT_TRUE(gradient.normals.allFinite() && gradient.material.allFinite() && gradient.radiance.allFinite()) << size;
  }
}

TEST(DifferentiableSum, SizesMustAgree) {
  const auto grid = light_grid<float>(4, 8);
  const Coefficients<float> material = Coefficients<float>::Zero();
  EXPECT_THROW(DifferentiableSum<float>(grid, material, Planes<float>::Zero(31, 3)), CheckFailed);
  const DifferentiableSum<float> sum(grid, material, Planes<float>::Zero(32, 3));
  EXPECT_THROW(sum.gradient(Planes<float>::Zero(4, 3), Planes<float>::Zero(5, 3)), CheckFailed);
  EXPECT_THROW(light_grid<float>(0, 8), CheckFailed);
}

}  // namespace
}  // namespace partwise
