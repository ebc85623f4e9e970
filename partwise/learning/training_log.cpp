#include "partwise/learning/training_log.h"

#include <chrono>
#include <sstream>
#include <string>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

void cut_back(const std::filesystem::path& path, std::int64_t step) {
  if (!std::filesystem::exists(path)) return;
  std::istringstream lines(read_bytes(path));
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    const auto entry = nlohmann::json::parse(line, nullptr, false);
    if (entry.is_object() && entry.value("step", step + 1) <= step) kept += line + "\n";
  }
  write_file(path, kept);
}

}  // namespace

TrainingLog::TrainingLog(const std::filesystem::path& folder, std::int64_t step)
    : path_(folder / "log.jsonl"), events_(folder) {
  cut_back(path_, step);
  lines_.open(path_, std::ios::app);
}

void TrainingLog::add(std::int64_t step, const char* group, const nlohmann::ordered_json& values) {
  const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  nlohmann::ordered_json line = {{"step", step}, {group, values}};
  lines_ << line.dump() << std::endl;
  if (!lines_) throw InputError(path_.string(), "cannot be written", "free some disk space, then go on with --resume");
  for (const auto& [name, value] : values.items()) {
    if (value.is_number()) events_.add(step, std::string(group) + "/" + name, value.get<float>(), now);
  }
  events_.flush();
}

}  // namespace partwise
