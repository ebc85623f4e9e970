// What a training says of itself as it goes: lines of JSON in log.jsonl, and scalars for TensorBoard. Internal to this
// room. Errors: InputError where they cannot be written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "partwise/learning/event_file.h"

namespace partwise {

class TrainingLog {
 public:
  // Goes on with the log of a folder after `step`; what lies beyond it is forgotten.
  TrainingLog(const std::filesystem::path& folder, std::int64_t step);

  // Numbers of `values` become scalars "GROUP/NAME".
  void add(std::int64_t step, const char* group, const nlohmann::ordered_json& values);

 private:
  std::filesystem::path path_;
  std::ofstream lines_;
  EventFile events_;
};

}  // namespace partwise
