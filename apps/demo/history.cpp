#include "history.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <sstream>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/shared_files.h"

namespace demo {

nlohmann::json newest_run(std::string_view bench, const std::function<bool(const nlohmann::json&)>& fits) {
  const std::filesystem::path file = partwise::shared_file(fmt::format("bench/history/{}.jsonl", bench));
  std::istringstream lines(partwise::read_bytes(file));
  std::optional<nlohmann::json> newest;
  for (std::string line; std::getline(lines, line);) {
    nlohmann::json run = nlohmann::json::parse(line);
    if (fits(run)) newest = std::move(run);
  }
  if (!newest) throw partwise::InputError(file.string(), "has no run that the page could show", "record one");
  return *newest;
}

std::string date_of(const nlohmann::json& run) { return run.at("date").get<std::string>().substr(0, 10); }

}  // namespace demo
