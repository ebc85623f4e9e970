#include "partwise/base/ranks.h"

#include <charconv>
#include <cstdlib>

#include "partwise/base/error.h"

namespace partwise {
namespace {

int number(const char* name, const std::string& text, int least) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least) {
    throw InputError(name, fmt::format("\"{}\" is not a whole number from {}", text, least),
                     "set it right, or unset it");
  }
  return value;
}

}  // namespace

Rank rank_of(const std::function<std::optional<std::string>(const char*)>& variable) {
  struct Pair {
    const char *rank, *size;
  };
  // WORLD_SIZE alone may be Kubernetes', whose index then stands in for RANK.
  const bool indexed = !variable("RANK") && variable("JOB_COMPLETION_INDEX") && variable("WORLD_SIZE");
  for (const auto& [rank_name, size_name] : {Pair{indexed ? "JOB_COMPLETION_INDEX" : "RANK", "WORLD_SIZE"},
                                             {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                             {"PMI_RANK", "PMI_SIZE"},
                                             {"SLURM_PROCID", "SLURM_NTASKS"}}) {
    const std::optional<std::string> rank = variable(rank_name), size = variable(size_name);
    if (!rank && !size) continue;
    if (!rank || !size) {
      throw InputError(rank ? rank_name : size_name, fmt::format("is set and {} is not", rank ? size_name : rank_name),
                       "set both or none");
    }
    const Rank result{number(rank_name, *rank, 0), number(size_name, *size, 1)};
    if (result.rank >= result.size) {
      throw InputError(rank_name, fmt::format("{} is not below {} = {}", result.rank, size_name, result.size),
                       "count ranks from 0");
    }
    return result;
  }
  return {};
}

Rank rank_from_environment() {
  return rank_of([](const char* name) -> std::optional<std::string> {
    const char* value = std::getenv(name);
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  });
}

}  // namespace partwise
