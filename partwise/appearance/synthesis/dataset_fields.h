// The configuration of a data set, or a piece of it, as part of another file. Internal to the project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/appearance/synthesis/dataset_config.h"
#include "partwise/base/json_fields.h"

namespace partwise {

// What read_dataset_config reads, from an object at `place` of `file`, whose files are named relative to `folder`.
DatasetConfig dataset_config_at(const nlohmann::json& object, const std::filesystem::path& file,
                                const std::string& place, const std::filesystem::path& folder);

// "shapes", "materials" and "lights", whose files are named relative to `folder`.
DatasetSources take_sources(JsonFields& fields, const std::filesystem::path& folder);

// "parts", "groups" and "tolerance" for these shapes, which have labels where the rule asks for them and only there.
PartSettings take_parts_of(JsonFields& fields, const std::vector<ShapeFile>& shapes);

}  // namespace partwise
