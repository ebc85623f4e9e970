#include "partwise/base/shared_files.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> places() {
  std::vector<fs::path> result;
  const char* chosen = std::getenv("PARTWISE_DATA");
  if (chosen != nullptr && *chosen != '\0') result.emplace_back(chosen);
  std::error_code error;
  // An installed copy may have been moved: the program knows where it is, the compiled prefix may be out of date.
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) result.push_back(program.parent_path().parent_path() / "share" / "partwise");
  result.emplace_back(PARTWISE_SHARE_FOLDER);
  result.emplace_back("/usr/share/partwise");  // a package's, where /proc is not mounted
  result.emplace_back(PARTWISE_SOURCE_FOLDER);
  return result;
}

}  // namespace

fs::path shared_file(const fs::path& name) {
  if (name.empty() || name.is_absolute()) {
    throw InputError(fmt::format("shared file '{}'", name.string()), "is not a relative name",
                     "name it as in the repository, for example data/README.md");
  }
  std::string tried;
  for (const fs::path& place : places()) {
    std::error_code error;
    if (fs::exists(place / name, error)) return place / name;
    tried += (tried.empty() ? "" : ", ") + place.string();
  }
  throw InputError(name.string(), fmt::format("is in none of {}", tried),
                   "set PARTWISE_DATA to the folder that holds data/ and models/");
}

}  // namespace partwise
