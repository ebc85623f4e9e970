#include "partwise/imaging/tile.h"

#include <gtest/gtest.h>

#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

TEST(Tile, PutsImagesRowByRow) {
  const std::vector<Image> images = {Image(2, 3, 1, 0.1f), Image(2, 3, 1, 0.2f), Image(2, 3, 1, 0.3f)};
  const Image sheet = tile(images, 2);
  ASSERT_EQ(sheet.width, 4);
  ASSERT_EQ(sheet.height, 6);
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 4; ++x) {
      const int number = y / 3 * 2 + x / 2;
      EXPECT_EQ(*sheet.pixel(x, y), number < 3 ? *images[static_cast<std::size_t>(number)].pixel(0, 0) : 0)
          << x << ", " << y;
    }
  }
}

TEST(Tile, RefusesWhatDoesNotFit) {
  const std::vector<Image> none, sizes = {Image(2, 3, 1), Image(3, 2, 1)}, channels = {Image(2, 3, 1), Image(2, 3, 3)};
  EXPECT_THROW(tile(none, 2), CheckFailed);
  EXPECT_THROW(tile(sizes, 2), CheckFailed);
  EXPECT_THROW(tile(channels, 2), CheckFailed);
  EXPECT_THROW(tile({sizes.data(), 1}, 0), CheckFailed);
}

}  // namespace
}  // namespace partwise
