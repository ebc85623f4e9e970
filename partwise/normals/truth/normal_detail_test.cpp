#include "partwise/normals/truth/normal_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "partwise/normals/truth/test_depths.h"

namespace partwise {
namespace {

constexpr int width = 60, height = 12, crease = 30;

// From the left a plane, up to a crease of 40 degrees; then a cylinder that turns by `bend` degrees a pixel.
Image creased(double bend) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double slant = x < crease ? -20 : 20 + bend * (x - crease);
      Eigen::Map<Eigen::Vector3f>(image.pixel(x, y)) = test::slanted(slant, 0).cast<float>();
    }
  }
  return image;
}

TEST(NormalDetail, EdgesCurvedAndSmoothPixelsShareOutTheImage) {
  Image truth = creased(1.5);
  std::fill_n(truth.pixel(29, 3), 3, 0.0f);  // a hole in the edge
  DetailSettings settings;
  settings.curved_turn = 1;
  const DetailRegions regions = detail_regions(truth, settings);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      SCOPED_TRACE(testing::Message() << x << ' ' << y);
      const bool hole = x == 29 && y == 3;
      // The pixels beside the crease have turned by 40 degrees: columns 29 and 30.
      const bool edge = !hole && x >= 27 && x <= 32;
      EXPECT_EQ(regions.edges.pixel(x, y)[0], edge ? 1 : 0);
      EXPECT_EQ(regions.curved.pixel(x, y)[0], !edge && !hole && x > 32 ? 1 : 0);
      EXPECT_EQ(regions.smooth.pixel(x, y)[0], !edge && !hole && x < 27 ? 1 : 0);
    }
  }
}

TEST(NormalDetail, LimitsAreTurnsAPixel) {
  const auto count = [](const Mask& mask) { return std::ranges::count(mask.values, 1.0f); };
  for (const auto& [bend, curved] : {std::pair{1.9, false}, std::pair{2.1, true}}) {
    const DetailRegions regions = detail_regions(creased(bend));
    EXPECT_EQ(count(regions.edges), 6 * height);
    EXPECT_EQ(count(regions.curved), curved ? 27 * height : 0) << bend;
  }
  DetailSettings settings;
  settings.edge_turn = 41;
  EXPECT_EQ(count(detail_regions(creased(0), settings).edges), 0);
  settings.edge_turn = 39;
  settings.edge_distance = 0;
  EXPECT_EQ(count(detail_regions(creased(0), settings).edges), 2 * height);
}

TEST(NormalDetail, TheBorderOfAnObjectIsNoEdge) {
  Image truth = creased(0);
  for (int y = 0; y < height; ++y) {
    for (int x = crease; x < width; ++x) std::fill_n(truth.pixel(x, y), 3, 0.0f);
  }
  const DetailRegions regions = detail_regions(truth);
  EXPECT_EQ(std::ranges::count(regions.edges.values, 1.0f), 0);
  EXPECT_EQ(std::ranges::count(regions.smooth.values, 1.0f), crease * height);
}

TEST(NormalDetail, AnEdgeThatIsSmearedCostsThereOnly) {
  const Image truth = creased(0);
  Image smeared = truth;
  for (int y = 0; y < height; ++y) {
    for (int x = crease - 1; x <= crease; ++x) {
      Eigen::Map<Eigen::Vector3f>(smeared.pixel(x, y)) = Eigen::Vector3f::UnitZ();
    }
  }
  DetailMeasure measure;
  measure.add(smeared, truth);
  EXPECT_NEAR(measure.edges.errors().mean, 20 * 2.0 / 6, 1e-4);  // off by 20 degrees in two columns of six
  EXPECT_NEAR(measure.all.errors().mean, 20 * 2.0 / width, 1e-4);
  EXPECT_NEAR(measure.smooth.errors().mean, 0, 1e-4);
  EXPECT_EQ(measure.curved.errors().pixels, 0u);
  EXPECT_EQ(measure.all.errors().pixels, measure.edges.errors().pixels + measure.smooth.errors().pixels);

  Mask left(width, height, 1);
  for (int y = 0; y < height; ++y) std::fill_n(left.pixel(0, y), crease, 1.0f);
  DetailMeasure masked;
  masked.add(smeared, truth, left);
  EXPECT_EQ(masked.edges.errors().pixels, 3u * height);
  masked.add(measure);
  EXPECT_EQ(masked.edges.errors().pixels, 9u * height);
}

}  // namespace
}  // namespace partwise
