#include "partwise/imaging/tile.h"

#include <algorithm>

#include "partwise/base/error.h"

namespace partwise {

Image tile(std::span<const Image> images, int columns) {
  PARTWISE_CHECK(images.size(), >, 0u);
  PARTWISE_CHECK(columns, >, 0);
  const Image& first = images.front();
  const auto count = static_cast<int>(images.size());
  Image sheet(columns * first.width, (count + columns - 1) / columns * first.height, first.channels);
  for (int i = 0; i < count; ++i) {
    const Image& image = images[static_cast<std::size_t>(i)];
    PARTWISE_CHECK(image.width, ==, first.width);
    PARTWISE_CHECK(image.height, ==, first.height);
    PARTWISE_CHECK(image.channels, ==, first.channels);
    for (int y = 0; y < first.height; ++y) {
      std::copy_n(image.pixel(0, y), first.width * first.channels,
                  sheet.pixel(i % columns * first.width, i / columns * first.height + y));
    }
  }
  return sheet;
}

}  // namespace partwise
