#include "partwise/learning/event_file.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

// A reader of the record format that shares nothing with the writer.
std::uint32_t crc32c(std::string_view bytes) {
  std::uint32_t crc = ~0u;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int i = 0; i < 8; ++i) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0x82F63B78u : 0u);
  }
  return ~crc;
}

std::uint32_t masked(std::string_view bytes) {
  const std::uint32_t crc = crc32c(bytes);
  return ((crc >> 15) | (crc << 17)) + 0xA282EAD8u;
}

template <typename Value>
Value take(std::string_view& bytes) {
  if (bytes.size() < sizeof(Value)) throw std::runtime_error("short");
  Value value;
  std::memcpy(&value, bytes.data(), sizeof(Value));
  bytes.remove_prefix(sizeof(Value));
  return value;
}

std::vector<std::string> records(std::string_view bytes) {
  std::vector<std::string> result;
  while (!bytes.empty()) {
    const std::string_view length_bytes = bytes.substr(0, 8);
    const auto length = take<std::uint64_t>(bytes);
    EXPECT_EQ(take<std::uint32_t>(bytes), masked(length_bytes));
    result.emplace_back(bytes.substr(0, length));
    bytes.remove_prefix(length);
    EXPECT_EQ(take<std::uint32_t>(bytes), masked(result.back()));
  }
  return result;
}

std::uint64_t varint(std::string_view& bytes) {
  std::uint64_t value = 0;
  for (int shift = 0;; shift += 7) {
    const auto byte = take<unsigned char>(bytes);
    value |= std::uint64_t{byte & 0x7Fu} << shift;
    if (byte < 0x80) return value;
  }
}

struct Event {
  double wall = 0;
  std::int64_t step = 0;
  std::string version, tag;
  float value = 0;
};

void read_message(std::string_view bytes, int depth, Event& event) {
  while (!bytes.empty()) {
    const std::uint64_t key = varint(bytes);
    const std::uint64_t field = key >> 3, type = key & 7;
    if (depth == 0 && field == 1 && type == 1)
      event.wall = take<double>(bytes);
    else if (depth == 0 && field == 2 && type == 0)
      event.step = static_cast<std::int64_t>(varint(bytes));
    else if (depth == 2 && field == 2 && type == 5)
      event.value = take<float>(bytes);
    else if (type == 2) {
      const std::uint64_t length = varint(bytes);
      const std::string_view inner = bytes.substr(0, length);
      bytes.remove_prefix(length);
      if (depth == 0 && field == 3)
        event.version = inner;
      else if ((depth == 0 && field == 5) || (depth == 1 && field == 1))
        read_message(inner, depth + 1, event);
      else if (depth == 2 && field == 1)
        event.tag = inner;
      else
        throw std::runtime_error("unknown field");
    } else {
      throw std::runtime_error("unknown field");
    }
  }
}

std::vector<Event> events(const std::filesystem::path& path) {
  std::vector<Event> result;
  for (const std::string& record : records(read_bytes(path))) read_message(record, 0, result.emplace_back());
  return result;
}

TEST(EventFile, HoldsWhatWasAdded) {
  EXPECT_EQ(crc32c("123456789"), 0xE3069283u);  // the published check value
  const TestFolder folder;
  EventFile file(folder.path());
  file.add(0, "training/loss", 0.1f, 1e9);
  file.add(-1, "a", -0.0f, 0);
  file.add(std::int64_t{1} << 40, std::string(300, 'x'), 3e38f, 1.7e9 + 0.25);
  file.flush();
  const std::vector<Event> found = events(file.path());
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].version, "brain.Event:2");
  EXPECT_GT(found[0].wall, 1.7e9);
  EXPECT_EQ(found[1].tag, "training/loss");
  EXPECT_EQ(found[1].value, 0.1f);
  EXPECT_EQ(found[1].step, 0);
  EXPECT_EQ(found[1].wall, 1e9);
  EXPECT_EQ(found[2].step, -1);
  EXPECT_EQ(std::bit_cast<std::uint32_t>(found[2].value), 0x80000000u);
  EXPECT_EQ(found[3].step, std::int64_t{1} << 40);
  EXPECT_EQ(found[3].tag, std::string(300, 'x'));
  EXPECT_EQ(found[3].wall, 1.7e9 + 0.25);
}

TEST(EventFile, EachObjectHasAFileOfItsOwn) {
  const TestFolder folder;
  EventFile first(folder.path()), second(folder.path());
  EXPECT_NE(first.path(), second.path());
  EXPECT_EQ(first.path().filename().string().rfind("events.out.tfevents.", 0), 0u);
  EXPECT_EQ(events(first.path()).size(), 1u);
}

TEST(EventFile, AFolderThatIsNotThere) { EXPECT_THROW(EventFile("/nowhere/at/all"), InputError); }

}  // namespace
}  // namespace partwise
