// The files that a configuration names: one by one, by patterns (* ? [abc]), or by the folder that they lie in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/base/json_fields.h"

namespace partwise::pipeline {

struct NamedFile {
  std::filesystem::path file;  // absolute
  std::string name;            // what its results are called by: of one file its own, below a folder or the fixed
                               // beginning of a pattern the way from there
};

// An absolute path without dots, the links of its folders followed.
std::filesystem::path absolute_file(const std::filesystem::path& folder, const std::string& name);

// Those of the texts at `field`, less those at `except` if there are any, in the order in which they are named, below
// folders and patterns in that of the alphabet; each once. Of a folder, those whose ending `is_one` knows.
// Errors: InputError for what is not there, and for two files of one name.
std::vector<NamedFile> take_files(JsonFields& fields, const std::string& field, const std::string& except,
                                  const std::filesystem::path& folder, bool (*is_one)(const std::filesystem::path&));

// Files that a field must name one by one. Errors: InputError for one that is not there.
std::filesystem::path take_file(JsonFields& fields, const std::string& field, const std::filesystem::path& folder);

}  // namespace partwise::pipeline
