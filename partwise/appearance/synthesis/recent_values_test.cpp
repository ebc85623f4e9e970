#include "partwise/appearance/synthesis/recent_values.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace partwise {
namespace {

struct Thing {
  int number;
  std::size_t bytes() const { return number == 9 ? 1000 : 10; }
};

TEST(RecentValues, KeepWhatWasAskedForLastWithinTheirBytes) {
  RecentValues<int, Thing> values(30);
  int made = 0;
  const auto ask = [&](int key) {
    const auto thing = values.get(key, [&] { return ++made, std::make_shared<const Thing>(Thing{key}); });
    EXPECT_EQ(thing->number, key);
    return made;
  };
  EXPECT_EQ((ask(1), ask(2), ask(3)), 3);
  EXPECT_EQ(ask(1), 3);  // now 2 is the oldest
  EXPECT_EQ(ask(4), 4);
  EXPECT_EQ((ask(1), ask(3), ask(4)), 4);
  EXPECT_EQ(ask(2), 5);
  EXPECT_EQ(ask(9), 6);  // too large to be kept
  EXPECT_EQ(ask(9), 7);
  EXPECT_EQ((ask(2), ask(3), ask(4)), 7);
}

}  // namespace
}  // namespace partwise
