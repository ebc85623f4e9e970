// Which network a training's configuration (docs/training.md) is for: its field "network". Errors: InputError for a
// file that cannot be read, is no JSON object, or does not say.
#pragma once

#include <filesystem>
#include <string>

namespace partwise {

std::string network_to_train(const std::filesystem::path& path);

}  // namespace partwise
