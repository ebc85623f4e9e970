// Files by patterns as shells have them: * ? [abc]. Internal to the project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace partwise {

bool is_pattern(const std::string& name);

// The pattern of `name` alone, whatever signs it holds.
std::string plain_pattern(const std::string& name);

// Those that are there, relative to `folder`, in the order of the alphabet; folders are none. Without a pattern: `name`
// itself.
std::vector<std::string> files_matching(const std::filesystem::path& folder, const std::string& name);

}  // namespace partwise
