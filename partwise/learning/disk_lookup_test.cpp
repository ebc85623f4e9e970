#include "partwise/learning/disk_lookup.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "partwise/appearance/rendering/reflectance_map.h"
#include "partwise/base/error.h"
#include "partwise/learning/test_learning.h"

namespace partwise {
namespace {

using test::random_material, test::random_normals, test::random_radiance;

TEST(DiskLookup, LooksUpAsAReflectanceMapDoes) {
  std::mt19937 random(11);
  const EnvironmentLight light = shipped_light("studio").resized(64, 32);
  const Dsbrdf material(random_material(random, false).matrix());
  const int size = 40;
  const ReflectanceMap map(material, light_samples(light), size);
  const DiskLookup<float> lookup(size);
  ASSERT_EQ(lookup.normals().rows(), map.normals());
  // The map's own texels, found where their normals are not turned away or the image is not zero: in rows, as they are.
  Planes<float> texels(map.normals(), 3);
  Eigen::Index at = 0;
  const Image& image = map.image();
  const double reach = 1 + 2 * std::sqrt(2.0) * 2 / (size - 3);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const double x = 2.0 / (size - 3) * (column - 1) - 1, y = 1 - 2.0 / (size - 3) * (row - 1);
      if (x * x + y * y > reach * reach) continue;
      for (int k = 0; k < 3; ++k) texels(at, k) = image.pixel(column, row)[k];
      ++at;
    }
  }
  ASSERT_EQ(at, map.normals());
  const Planes<float> normals = random_normals(random, 500).cast<float>();
  const Planes<float> colours = lookup.colours(texels, normals);
  EXPECT_TRUE((colours.row(0) == 0).all());
  for (Eigen::Index i = 1; i < normals.rows(); ++i) {
    const Eigen::Vector3f expected = map.colour(normals.row(i).matrix().transpose());
    EXPECT_LT((colours.row(i).matrix().transpose() - expected).norm(), 1e-5f * expected.norm()) << normals.row(i);
  }
}

TEST(DiskLookup, GradientsMeetFiniteDifferences) {
  std::mt19937 random(12);
  const DiskLookup<double> lookup(12);
  // Smooth with some noise: colours above zero, and in one corner below, where they are cut off.
  Planes<double> texels =
      lookup.normals() + 0.9 + 0.02 * random_radiance(random, static_cast<int>(lookup.normals().rows()));
  const Planes<double> all = random_normals(random, 60), factors = random_radiance(random, 59) - 0.6;
  Planes<double> normals = all.bottomRows(59);
  const auto loss = [&] { return (factors * lookup.colours(texels, normals)).sum(); };
  ASSERT_TRUE((lookup.colours(texels, normals) == 0).any());
  const auto gradient = lookup.gradient(texels, normals, factors);
  test::expect_gradient(texels, gradient.texels, loss);
  test::expect_gradient(normals, gradient.normals, loss);
}

TEST(DiskLookup, TheSameBitsForAnyNumberOfThreads) {
  std::mt19937 random(13);
  const DiskLookup<float> lookup(33);
  const Planes<float> texels = random_radiance(random, static_cast<int>(lookup.normals().rows())).cast<float>();
  const Planes<float> normals = random_normals(random, 20000).cast<float>();
  const auto gradient = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return lookup.gradient(texels, normals, normals);
  };
  const auto one = gradient(1), many = gradient(4);
  EXPECT_TRUE((one.texels == many.texels).all());
  EXPECT_TRUE((one.normals == many.normals).all());
}

TEST(DiskLookup, SizesMustAgree) {
  EXPECT_THROW(DiskLookup<float>(7), CheckFailed);
  const DiskLookup<float> lookup(8);
  EXPECT_THROW(lookup.colours(Planes<float>::Zero(5, 3), Planes<float>::Zero(5, 3)), CheckFailed);
}

}  // namespace
}  // namespace partwise
