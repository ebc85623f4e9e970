// Where the files are that ship with the project: data/ (small inputs) and models/ (what was fitted or trained).
//
// Looked for in this order, the first place that has the file wins:
//   1. the folder that the environment variable PARTWISE_DATA names (it holds data/ and models/);
//   2. the installed share folder: share/partwise beside the running program's bin/, under the prefix, under /usr;
//   3. the source tree that the library was built from.
#pragma once

#include <filesystem>

namespace partwise {

// The path of a shipped file or folder, named as in the repository: "data/README.md", "models".
// Errors: InputError when no place has it (the message names them all), or for a name that is not relative.
std::filesystem::path shared_file(const std::filesystem::path& name);

}  // namespace partwise
