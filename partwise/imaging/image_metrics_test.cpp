#include "partwise/imaging/image_metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "partwise/base/error.h"

namespace partwise {
namespace {

Image noise(int width, int height, int channels, unsigned seed) {
  Image image(width, height, channels);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(0, 255);
  for (float& each : image.values) each = value(random);
  return image;
}

// SSIM of one window by its definition: weights that are not a product, and central moments.
double ssim_at(const Image& a, const Image& b, int cx, int cy, int channel) {
  double weight_sum = 0, mean_a = 0, mean_b = 0, var_a = 0, var_b = 0, covariance = 0;
  const auto each = [&](const auto& visit) {
    for (int y = -5; y <= 5; ++y) {
      for (int x = -5; x <= 5; ++x) {
        visit(std::exp(-(x * x + y * y) / 4.5), static_cast<double>(a.pixel(cx + x, cy + y)[channel]),
              static_cast<double>(b.pixel(cx + x, cy + y)[channel]));
      }
    }
  };
  each([&](double w, double u, double v) { weight_sum += w, mean_a += w * u, mean_b += w * v; });
  mean_a /= weight_sum, mean_b /= weight_sum;
  each([&](double w, double u, double v) {
    var_a += w / weight_sum * (u - mean_a) * (u - mean_a);
    var_b += w / weight_sum * (v - mean_b) * (v - mean_b);
    covariance += w / weight_sum * (u - mean_a) * (v - mean_b);
  });
  const double c1 = 6.5025, c2 = 58.5225;
  return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
         ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
}

TEST(ImageMetrics, SsimIsThatOfItsDefinition) {
  const Image a = noise(19, 14, 3, 1), b = noise(19, 14, 3, 2);
  Mask mask(19, 14, 1);
  double whole = 0, masked = 0;
  int windows = 0, inside = 0;
  for (int y = 5; y < 9; ++y) {
    for (int x = 5; x < 14; ++x) {
      const bool in = (x * 7 + y * 3) % 4 == 0;
      mask.pixel(x, y)[0] = in ? 1 : 0;
      for (int k = 0; k < 3; ++k) {
        const double value = ssim_at(a, b, x, y, k);
        whole += value, ++windows;
        if (in) masked += value, ++inside;
      }
    }
  }
  EXPECT_NEAR(compare_images(a, b).ssim.value(), whole / windows, 1e-9);
  EXPECT_NEAR(compare_images(a, b, mask).ssim.value(), masked / inside, 1e-9);
}

TEST(ImageMetrics, ConstantImagesHaveClosedForms) {
  const Image a(16, 16, 3, 100), b(16, 16, 3, 150);
  const ImageDifference difference = compare_images(a, b);
  EXPECT_DOUBLE_EQ(difference.squared_error, 2500);
  EXPECT_NEAR(difference.psnr, 20 * std::log10(255.0 / 50), 1e-12);
  EXPECT_NEAR(difference.ssim.value(), (2 * 100 * 150 + 6.5025) / (100 * 100 + 150 * 150 + 6.5025), 1e-9);
}

TEST(ImageMetrics, EqualImagesAreEqual) {
  const Image a = noise(20, 20, 3, 3);
  const ImageDifference difference = compare_images(a, a);
  EXPECT_EQ(difference.squared_error, 0);
  EXPECT_EQ(difference.psnr, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(difference.ssim.value(), 1, 1e-12);
}

TEST(ImageMetrics, AMaskCountsItsPixelsOnly) {
  Image a(12, 12, 1, 10), b(12, 12, 1, 10);
  a.pixel(0, 0)[0] = 16;
  Mask corner(12, 12, 1);
  corner.pixel(0, 0)[0] = corner.pixel(1, 0)[0] = 1;
  EXPECT_DOUBLE_EQ(compare_images(a, b, corner).squared_error, 18);
  EXPECT_DOUBLE_EQ(compare_images(a, b).squared_error, 36.0 / 144);
  EXPECT_FALSE(compare_images(a, b, corner).ssim.has_value());  // no window around the corner
  EXPECT_THROW(compare_images(a, b, Mask(12, 12, 1)), CheckFailed);
}

TEST(ImageMetrics, RelativeErrorIsOverTheTruth) {
  Image truth(2, 1, 1, 2.0f), image = truth;
  EXPECT_EQ(relative_error(image, truth), 0);
  image.values = {1, 4};
  EXPECT_EQ(relative_error(image, truth), 0.75);
}

}  // namespace
}  // namespace partwise
