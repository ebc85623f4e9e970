// Scalars in the files that TensorBoard reads.
//
// A file is a series of records: the length of the data (8 bytes, little-endian), a checksum of these, the data, a
// checksum of it. Checksums are CRC-32C, rotated and offset as TensorFlow's TFRecord has them; data are protocol
// buffers of the message Event. Each object starts a file of its own, events.out.tfevents.SECONDS.HOST.PROCESS.NUMBER;
// TensorBoard shows those of a folder as one run. Errors: InputError for a file that cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace partwise {

class EventFile {
 public:
  explicit EventFile(const std::filesystem::path& folder);

  void add(std::int64_t step, const std::string& tag, float value, double wall_seconds);  // since 1970
  void flush();

  const std::filesystem::path& path() const { return path_; }

 private:
  void write_record(std::string_view data);

  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace partwise
