#include "partwise/parts/planar/read_segmentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/geometry/polygon_validity.h"
#include "partwise/imaging/png.h"
#include "partwise/parts/planar/segmentation_measures.h"

namespace partwise {
namespace {

// A letter a pixel; '.' is black.
Image painted(const std::vector<std::string>& rows) {
  Image image(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const char letter = rows[y][x];
      if (letter != '.') image.pixel(x, y)[letter % 3] = 0.1f * static_cast<float>(letter - 'a' + 1);
    }
  }
  return image;
}

TEST(LabelImage, PartsAreThePixelsOfAColour) {
  const PlanarSegmentation parts = label_image_segmentation(painted({"aaab.", "a.abb", "aaab.", "..a.b"}), "labels");
  // One region of a with a hole, one of b; a lone b on the diagonal; the lower a hangs on the row above.
  ASSERT_EQ(parts.polygons.size(), 3u);
  std::map<int, double> areas;
  for (std::size_t i = 0; i < parts.polygons.size(); ++i) areas[parts.part[i]] += area(parts.polygons[i]);
  EXPECT_THAT(areas, testing::ElementsAre(testing::Pair(0, 9), testing::Pair(1, 5)));
  EXPECT_EQ(parts.polygons[0].holes.size(), 1u);
  for (const Polygon& polygon : parts.polygons) {
    EXPECT_GT(signed_area(polygon.outer), 0);
    EXPECT_FALSE(find_fault(std::vector{polygon}).has_value());
  }
}

TEST(LabelImage, CutsAreWhereColoursMeet) {
  const PlanarSegmentation parts = label_image_segmentation(painted({"aabb", "aabb", "aabb", "..cc"}), "labels");
  const std::vector<CutLine> cuts = cut_lines(parts.polygons);
  EXPECT_THAT(cuts, testing::UnorderedElementsAre(CutLine(2, 0, 2, 3), CutLine(2, 3, 4, 3)));
}

TEST(LabelImage, AgreesWithTheSameDecompositionAsPolygons) {
  Image image(40, 30, 1);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) *image.pixel(x, y) = x < 15 ? 0.2f : y < 10 ? 0.5f : 1.0f;
  }
  const auto box = [](double x0, double y0, double x1, double y1) {
    Ring ring(4, 2);
    ring << x0, y0, x1, y0, x1, y1, x0, y1;
    return Polygon{ring, {}};
  };
  const Polygons same{box(0, 0, 15, 30), box(15, 0, 40, 10), box(15, 10, 40, 30)}, other{box(0, 0, 40, 30)};
  const PlanarSegmentation parts = label_image_segmentation(image, "labels");
  const auto grid = [](const Polygons& polygons, std::span<const int> owner) {
    return label_grid(polygons, {0, 0}, {40, 30}, 120, owner);
  };
  EXPECT_EQ(rand_index(grid(parts.polygons, parts.part), grid(same, {})), 1);
  // What both put into one part: pairs of cells of one part of the image, of 45 x 120, 75 x 40 and 75 x 80 cells.
  const double n = 14400, expected = (5400 * 5399.0 + 3000 * 2999.0 + 6000 * 5999.0) / (n * (n - 1));
  EXPECT_NEAR(rand_index(grid(parts.polygons, parts.part), grid(other, {})), expected, 1e-12);
}

TEST(LabelImage, OneColourInTwoPlacesIsOnePart) {
  const PlanarSegmentation parts = label_image_segmentation(painted({"aabbaa"}), "labels");
  const LabelGrid grid = label_grid(parts.polygons, {0, 0}, {6, 1}, 6, parts.part);
  EXPECT_THAT(std::vector(grid.labels.begin(), grid.labels.begin() + 6), testing::ElementsAre(0, 0, 1, 1, 0, 0));
}

class ReadSegmentation : public testing::Test {
 protected:
  const TestFolder own_;
  const std::filesystem::path folder_ = own_.path();
};

TEST_F(ReadSegmentation, TakesPicturesAndPolygons) {
  const Image image = painted({"ab", "ab"});
  write_png(folder_ / "a.PNG", image);
  const PlanarSegmentation picture = read_segmentation(folder_ / "a.PNG");
  write_geojson(folder_ / "a.geojson", picture.polygons);
  const PlanarSegmentation polygons = read_segmentation(folder_ / "a.geojson");
  ASSERT_EQ(polygons.polygons.size(), 2u);
  EXPECT_EQ(polygons.part, picture.part);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(polygons.polygons[i].outer, picture.polygons[i].outer);
}

TEST_F(ReadSegmentation, Refusals) {
  write_png(folder_ / "black.png", Image(4, 4, 3));
  EXPECT_THROW(read_segmentation(folder_ / "black.png"), InputError);
  EXPECT_THROW(read_segmentation(folder_ / "missing.png"), InputError);
  Image photograph(80, 80, 3);
  for (int i = 0; i < 6400; ++i) {
    photograph.values[3 * i] = 0.1f + static_cast<float>(i % 80) / 100;
    photograph.values[3 * i + 1] = static_cast<float>(i / 80) / 100;
  }
  EXPECT_THROW(label_image_segmentation(photograph, "photograph"), InputError);
}

}  // namespace
}  // namespace partwise
