// All bytes of a file.
//
// Errors: InputError when it does not exist, is a folder or a device, or cannot be read.
#pragma once

#include <filesystem>
#include <string>

namespace partwise {

std::string read_bytes(const std::filesystem::path& path);

}  // namespace partwise
