// What benchmarks measured before: the lines of bench/history/, each of one run with its date.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace demo {

// The newest line of bench/history/BENCH.jsonl that fits. Errors: InputError if none does.
nlohmann::json newest_run(std::string_view bench, const std::function<bool(const nlohmann::json&)>& fits);

// "2026-11-25"
std::string date_of(const nlohmann::json& run);

}  // namespace demo
