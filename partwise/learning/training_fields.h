// The fields of a training's configuration that all networks share (docs/training.md). Internal to the rooms that have
// networks. Errors: InputError that names the field.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "partwise/base/json_fields.h"
#include "partwise/learning/training_loop.h"

namespace partwise {

inline constexpr const char* training_page = "docs/training.md";

// A configuration; `seed`, unless it is 0, goes before its own. Errors: those of reading.
nlohmann::json read_training_file(const std::filesystem::path& path, std::uint64_t seed);

// All but the stages, and the configuration's own text.
TrainingSettings take_training_settings(JsonFields& fields);

// The objects of "stages"; each may hold more than take_stage takes.
std::vector<JsonFields> take_stages(JsonFields& fields, const std::string& file);
TrainingStage take_stage(JsonFields& fields);

}  // namespace partwise
