// Pieces of a training's configuration that the trainings of editing and of normals share. Internal to the project.
// Errors: InputError that names the field.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/base/json_fields.h"
#include "partwise/editing/sampled_task.h"

namespace partwise {

// Of a stage: the weights of the terms of its loss.
EditingWeights take_weights(JsonFields& stage);

// Of a field, named relative to `base`.
std::vector<std::filesystem::path> take_folders(JsonFields& fields, const char* name,
                                                const std::filesystem::path& base);

}  // namespace partwise
