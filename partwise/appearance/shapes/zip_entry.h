// One entry of a zip archive, in memory.
#pragma once

#include <filesystem>
#include <string>

namespace partwise {

// Errors: InputError for a file that is no zip archive or is damaged, an entry that is not there or too large.
std::string read_zip_entry(const std::filesystem::path& archive, const std::string& entry);

}  // namespace partwise
