#include "partwise/appearance/synthesis/file_patterns.h"

#include <glob.h>

#include <algorithm>

namespace partwise {

bool is_pattern(const std::string& name) { return name.find_first_of("*?[") != std::string::npos; }

std::string plain_pattern(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (c == '*' || c == '?' || c == '[' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

std::vector<std::string> files_matching(const std::filesystem::path& folder, const std::string& name) {
  std::error_code error;
  if (!is_pattern(name)) {
    return std::filesystem::exists(folder / name, error) ? std::vector{name} : std::vector<std::string>();
  }
  const bool is_relative = !name.starts_with('/') && !folder.empty();
  const std::string before = is_relative ? folder.string() + "/" : "";
  glob_t found{};
  std::vector<std::string> result;
  if (::glob((plain_pattern(before) + name).c_str(), GLOB_NOSORT, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
      const std::string path = found.gl_pathv[i];
      if (!std::filesystem::is_directory(path, error)) result.push_back(path.substr(before.size()));
    }
  }
  ::globfree(&found);
  std::ranges::sort(result);
  return result;
}

}  // namespace partwise
