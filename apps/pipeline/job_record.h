// What a job was made from and what it left, kept as job.json in its folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace partwise::pipeline {

// A file and what it held. Names are relative to the output folder; what ships with the program is named as in the
// repository, after "partwise:".
struct FileState {
  std::string name;
  std::string hash;

  bool operator==(const FileState& other) const = default;
};

struct JobRecord {
  std::string partwise;  // the version
  std::string asked;     // hash of the version, the words of the command and the files that were given
  std::vector<std::string> words;
  std::vector<FileState> inputs;   // all that was read, by name
  std::vector<FileState> outputs;  // by name; empty as long as the job is not done
  double seconds = 0;
  nlohmann::ordered_json report = nlohmann::ordered_json::object();  // the verb's own

  // Of all that the outputs are made from.
  std::string key() const;
};

nlohmann::ordered_json as_json(const JobRecord& record);

// Nothing where there is none, or none that can be read.
std::optional<JobRecord> read_record(const std::filesystem::path& folder);
// Atomic. Errors: InputError.
void write_record(const std::filesystem::path& folder, const JobRecord& record);

inline constexpr const char* record_name = "job.json";

}  // namespace partwise::pipeline
