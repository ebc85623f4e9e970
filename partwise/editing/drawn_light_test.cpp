#include "partwise/editing/drawn_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace partwise {
namespace {

// Red from one place, nothing blue.
EnvironmentLight red_light() {
  Image radiance(64, 32, 3);
  for (int x = 20; x < 24; ++x) radiance.pixel(x, 10)[0] = 5;
  for (int y = 0; y < 32; ++y) radiance.pixel(50, y)[1] = 0.5f;
  return EnvironmentLight(std::move(radiance));
}

TEST(DrawnLight, IsPhotographedOrLamps) {
  const EnvironmentLight map = red_light();
  constexpr int draws = 400;
  int of_lamps = 0, mirrored = 0, one_map = 0;
  for (int i = 0; i < draws; ++i) {
    Draw draw(3, static_cast<std::uint64_t>(i), 0);
    const EnvironmentLight light = drawn_light(draw, {map});
    const std::vector<float>& values = light.radiance().values;
    ASSERT_TRUE(std::ranges::all_of(values, [](float each) { return std::isfinite(each) && each >= 0; }));
    ASSERT_EQ(light.width(), 64);
    if (light.energy().z() > 0) {
      ++of_lamps;
      EXPECT_GT(*std::ranges::min_element(values), 0);  // the sky is nowhere dark
      continue;
    }
    // Between 2^-0.25 of one map and 2^0.25 of two.
    EXPECT_GT(light.energy().x(), 0.84 * map.energy().x());
    EXPECT_LT(light.energy().x(), 2.38 * map.energy().x());
    // Green follows red by 27 to 30 columns, in a mirror by 34 to 37.
    int red = 0, green = 0, reds = 0;
    for (int x = 0; x < 64; ++x) {
      if (light.radiance().pixel(x, 10)[0] > 0) ++reds;
      if (light.radiance().pixel(x, 10)[0] > light.radiance().pixel(red, 10)[0]) red = x;
      if (light.radiance().pixel(x, 2)[1] > light.radiance().pixel(green, 2)[1]) green = x;
    }
    if (reds > 5) continue;  // two maps
    ++one_map;
    mirrored += (green - red + 64) % 64 > 32 ? 1 : 0;
  }
  EXPECT_NEAR(of_lamps, draws / 4, 30);
  EXPECT_NEAR(one_map, draws * 3 / 8, 45);
  EXPECT_NEAR(mirrored, one_map / 2, 25);
}

TEST(DrawnLight, DependsOnTheDrawAlone) {
  for (const std::uint64_t number : {1u, 2u, 3u, 4u}) {
    Draw first(3, number, 1), second(3, number, 1);
    EXPECT_EQ(drawn_light(first, {red_light()}).radiance().values,
              drawn_light(second, {red_light()}).radiance().values);
  }
}

}  // namespace
}  // namespace partwise
