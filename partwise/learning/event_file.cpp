#include "partwise/learning/event_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <boost/crc.hpp>
#include <chrono>

#include "partwise/base/error.h"

namespace partwise {
namespace {

using Crc32c = boost::crc_optimal<32, 0x1EDC6F41, 0xFFFFFFFF, 0xFFFFFFFF, true, true>;

template <typename Whole>
void put_little_endian(std::string& bytes, Whole value) {
  for (std::size_t i = 0; i < sizeof(Whole); ++i) bytes.push_back(static_cast<char>(value >> 8 * i & 0xFF));
}

std::uint32_t masked_checksum(std::string_view bytes) {
  Crc32c crc;
  crc.process_bytes(bytes.data(), bytes.size());
  const std::uint32_t sum = crc.checksum();
  constexpr int rotation = 15;
  constexpr std::uint32_t offset = 0xA282EAD8;
  return std::rotr(sum, rotation) + offset;
}

// Fields of protocol buffers.
enum WireType { varint = 0, eight_bytes = 1, sized = 2, four_bytes = 5 };

void put_varint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes.push_back(static_cast<char>(value | 0x80));
  bytes.push_back(static_cast<char>(value));
}

void put_key(std::string& bytes, int field, WireType type) {
  put_varint(bytes, static_cast<std::uint64_t>(field << 3 | type));
}

void put_text(std::string& bytes, int field, std::string_view text) {
  put_key(bytes, field, sized);
  put_varint(bytes, text.size());
  bytes += text;
}

// An Event's first field.
std::string event_at(double wall_seconds) {
  std::string event;
  put_key(event, 1, eight_bytes);
  put_little_endian(event, std::bit_cast<std::uint64_t>(wall_seconds));
  return event;
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0' ? name.data() : "localhost";
}

}  // namespace

EventFile::EventFile(const std::filesystem::path& folder) {
  static std::atomic<int> number = 0;
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  path_ = folder / fmt::format("events.out.tfevents.{:010}.{}.{}.{}", static_cast<std::int64_t>(now), host_name(),
                               getpid(), number++);
  file_.open(path_, std::ios::binary | std::ios::trunc);
  std::string event = event_at(now);
  put_text(event, 3, "brain.Event:2");
  write_record(event);
  flush();
}

void EventFile::add(std::int64_t step, const std::string& tag, float value, double wall_seconds) {
  std::string scalar;
  put_text(scalar, 1, tag);
  put_key(scalar, 2, four_bytes);
  put_little_endian(scalar, std::bit_cast<std::uint32_t>(value));
  std::string summary;
  put_text(summary, 1, scalar);
  std::string event = event_at(wall_seconds);
  put_key(event, 2, varint);
  put_varint(event, static_cast<std::uint64_t>(step));
  put_text(event, 5, summary);
  write_record(event);
}

void EventFile::write_record(std::string_view data) {
  std::string record;
  put_little_endian(record, static_cast<std::uint64_t>(data.size()));
  put_little_endian(record, masked_checksum(record));
  record += data;
  put_little_endian(record, masked_checksum(data));
  file_.write(record.data(), static_cast<std::streamsize>(record.size()));
}

void EventFile::flush() {
  file_.flush();
  if (!file_) throw InputError(path_.string(), "cannot be written", "free some disk space, or name another folder");
}

}  // namespace partwise
