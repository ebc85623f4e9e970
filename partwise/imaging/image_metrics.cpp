#include "partwise/imaging/image_metrics.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr int window = 11, reach = window / 2;
constexpr double sigma = 1.5, peak = 255;

// One channel of two images and what SSIM needs of it: the means of a, b, aa, bb and ab under the window.
using Moments = std::array<double, 5>;

std::array<double, window> gaussian() {
  std::array<double, window> weights{};
  double sum = 0;
  for (int i = 0; i < window; ++i) {
    weights[static_cast<std::size_t>(i)] = std::exp(-(i - reach) * (i - reach) / (2 * sigma * sigma));
    sum += weights[static_cast<std::size_t>(i)];
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

double similarity(const Moments& mean) {
  constexpr double c1 = 0.01 * peak * 0.01 * peak, c2 = 0.03 * peak * 0.03 * peak;
  const auto [a, b, aa, bb, ab] = mean;
  return (2 * a * b + c1) * (2 * (ab - a * b) + c2) / ((a * a + b * b + c1) * (aa - a * a + bb - b * b + c2));
}

// The window is a product: first along rows, then along columns. Index: (width - 10) x (height - 10) window centres.
std::vector<double> similarities(const Image& image, const Image& truth, int channel) {
  static const std::array<double, window> weights = gaussian();
  const int across = image.width - 2 * reach, down = image.height - 2 * reach;
  if (across < 1 || down < 1) return {};
  std::vector<Moments> rows(static_cast<std::size_t>(across) * static_cast<std::size_t>(image.height));
  std::size_t at = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < across; ++x, ++at) {
      for (int i = 0; i < window; ++i) {
        const double a = image.pixel(x + i, y)[channel], b = truth.pixel(x + i, y)[channel];
        const Moments moments{a, b, a * a, b * b, a * b};
        for (std::size_t k = 0; k < 5; ++k) rows[at][k] += weights[static_cast<std::size_t>(i)] * moments[k];
      }
    }
  }
  std::vector<double> result;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      Moments mean{};
      for (int i = 0; i < window; ++i) {
        const Moments& row =
            rows[static_cast<std::size_t>(y + i) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x)];
        for (std::size_t k = 0; k < 5; ++k) mean[k] += weights[static_cast<std::size_t>(i)] * row[k];
      }
      result.push_back(similarity(mean));
    }
  }
  return result;
}

template <typename Counts>
double mean_squared_error(const Image& image, const Image& truth, const Counts& counts) {
  double sum = 0, pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!counts(x, y)) continue;
      ++pixels;
      for (int k = 0; k < image.channels; ++k) {
        const double difference = static_cast<double>(image.pixel(x, y)[k]) - static_cast<double>(truth.pixel(x, y)[k]);
        sum += difference * difference;
      }
    }
  }
  PARTWISE_CHECK(pixels, >, 0);
  return sum / (pixels * image.channels);
}

template <typename Counts>
std::optional<double> mean_similarity(const Image& image, const Image& truth, const Counts& counts) {
  double sum = 0, terms = 0;
  for (int channel = 0; channel < image.channels; ++channel) {
    const std::vector<double> all = similarities(image, truth, channel);
    const int across = image.width - 2 * reach;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const int at = static_cast<int>(i);
      if (!counts(at % across + reach, at / across + reach)) continue;
      sum += all[i];
      ++terms;
    }
  }
  return terms > 0 ? std::optional(sum / terms) : std::nullopt;
}

template <typename Counts>
ImageDifference compare(const Image& image, const Image& truth, const Counts& counts) {
  PARTWISE_CHECK(image.width, ==, truth.width);
  PARTWISE_CHECK(image.height, ==, truth.height);
  PARTWISE_CHECK(image.channels, ==, truth.channels);
  const double error = mean_squared_error(image, truth, counts);
  return {error, 10 * std::log10(peak * peak / error), mean_similarity(image, truth, counts)};
}

}  // namespace

ImageDifference compare_images(const Image& image, const Image& truth) {
  return compare(image, truth, [](int, int) { return true; });
}

ImageDifference compare_images(const Image& image, const Image& truth, const Mask& mask) {
  PARTWISE_CHECK(mask.width, ==, image.width);
  PARTWISE_CHECK(mask.height, ==, image.height);
  PARTWISE_CHECK(mask.channels, ==, 1);
  return compare(image, truth, [&](int x, int y) { return mask.pixel(x, y)[0] > 0.5f; });
}

double relative_error(const Image& image, const Image& truth) {
  PARTWISE_CHECK(image.values.size(), ==, truth.values.size());
  double difference = 0, level = 0;
  for (std::size_t i = 0; i < truth.values.size(); ++i) {
    difference += std::abs(static_cast<double>(image.values[i]) - static_cast<double>(truth.values[i]));
    level += static_cast<double>(truth.values[i]);
  }
  return difference / level;
}

}  // namespace partwise
