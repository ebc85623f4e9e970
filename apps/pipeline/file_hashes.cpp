#include "pipeline/file_hashes.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>
#include <new>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"

namespace partwise::pipeline {
namespace {

constexpr std::int64_t second = 1'000'000'000;

std::string as_text(const XXH128_hash_t& hash) { return fmt::format("{:016x}{:016x}", hash.high64, hash.low64); }

std::int64_t nanoseconds(const timespec& time) { return time.tv_sec * second + time.tv_nsec; }

std::int64_t time_now() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return nanoseconds(now);
}

[[noreturn]] void refuse(const std::filesystem::path& file) {
  throw InputError(file.string(), fmt::format("cannot be read ({})", std::strerror(errno)),
                   "check that you may read it");
}

std::string hash_of_file(const std::filesystem::path& file) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), &XXH3_freeState);
  if (state == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(state.get());
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file);
  std::vector<char> block(1 << 20);
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
    XXH3_128bits_update(state.get(), block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  if (stream.bad()) refuse(file);
  return as_text(XXH3_128bits_digest(state.get()));
}

}  // namespace

std::string hash_of(std::string_view bytes) { return as_text(XXH3_128bits(bytes.data(), bytes.size())); }

FileHashes::FileHashes(std::filesystem::path memory) : memory_(std::move(memory)) {
  std::ifstream lines(memory_);
  Place place;
  Seen seen;
  while (lines >> place.first >> place.second >> seen.bytes >> seen.modified >> seen.changed >> seen.hash) {
    before_[place] = seen;
  }
}

std::string FileHashes::of(const std::filesystem::path& file) {
  struct stat found = {};
  if (::stat(file.c_str(), &found) != 0) refuse(file);
  const Place place(found.st_dev, found.st_ino);
  Seen seen{static_cast<std::uint64_t>(found.st_size), nanoseconds(found.st_mtim), nanoseconds(found.st_ctim), ""};
  for (const std::map<Place, Seen>* known : {&now_, &before_}) {
    const auto kept = known->find(place);
    if (kept == known->end()) continue;
    seen.hash = kept->second.hash;
    if (seen == kept->second) return (now_[place] = seen).hash;
  }
  seen.hash = hash_of_file(file);
  if (time_now() - std::max(seen.modified, seen.changed) > 2 * second) now_[place] = seen;
  return seen.hash;
}

void FileHashes::save() const {
  std::string text;
  for (const auto& [place, seen] : now_) {
    text += fmt::format("{} {} {} {} {} {}\n", place.first, place.second, seen.bytes, seen.modified, seen.changed,
                        seen.hash);
  }
  write_file(memory_, text);
}

}  // namespace partwise::pipeline
