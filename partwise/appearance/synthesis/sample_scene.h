// An image of a data set as a scene file (docs/render.md): everything that it takes to render it again, and under
// "about" what people and loaders want to know. Files are named as the configuration names them. Internal to this room.
#pragma once

#include <cstdint>
#include <string>

#include "partwise/appearance/synthesis/dataset_config.h"
#include "partwise/appearance/synthesis/sample_plan.h"

namespace partwise {

double light_rotation(const Sample& sample);  // degrees
ShareView sample_view(const DatasetConfig& config, int viewpoint);

std::string sample_scene(const DatasetConfig& config, std::uint64_t number, const Sample& sample);

}  // namespace partwise
