#include "pipeline/named_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "partwise/appearance/synthesis/file_patterns.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;

// The folders of a pattern before its first sign, with the slash.
std::string fixed_beginning(const std::string& pattern) {
  const std::size_t slash = pattern.rfind('/', pattern.find_first_of("*?["));
  return slash == std::string::npos ? "" : pattern.substr(0, slash + 1);
}

std::vector<NamedFile> in_folder(const fs::path& folder, bool (*is_one)(const fs::path&)) {
  std::vector<NamedFile> found;
  for (const fs::directory_entry& each : fs::directory_iterator(folder)) {
    if (each.is_regular_file() && is_one(each.path())) found.push_back({each.path(), each.path().filename().string()});
  }
  std::ranges::sort(found, {}, &NamedFile::name);
  return found;
}

std::vector<NamedFile> matching(const JsonFields& fields, const std::string& field, const std::string& name,
                                const fs::path& folder, bool (*is_one)(const fs::path&)) {
  std::error_code error;
  std::vector<NamedFile> found;
  const fs::path place = absolute_file(folder, name);
  if (!is_pattern(name) && fs::is_directory(place, error)) {
    found = in_folder(place, is_one);
    if (found.empty())
      fields.refuse(field, fmt::format("\"{}\" is a folder without such a file", name), "name another");
    return found;
  }
  const std::size_t beginning = is_pattern(name) ? fixed_beginning(name).size() : name.rfind('/') + 1;
  for (const std::string& each : files_matching(folder, name)) {
    found.push_back({absolute_file(folder, each), each.substr(beginning)});
  }
  if (found.empty()) {
    fields.refuse(field, fmt::format("\"{}\" {}", name, is_pattern(name) ? "matches no file" : "does not exist"),
                  "name files relative to the configuration's folder");
  }
  return found;
}

}  // namespace

fs::path absolute_file(const fs::path& folder, const std::string& name) {
  const fs::path whole = (folder / name).lexically_normal();
  const fs::path file = whole.has_filename() ? whole : whole.parent_path();
  return fs::weakly_canonical(file.parent_path()) / file.filename();
}

std::vector<NamedFile> take_files(JsonFields& fields, const std::string& field, const std::string& except,
                                  const fs::path& folder, bool (*is_one)(const fs::path&)) {
  std::set<fs::path> left_out, taken;
  if (!except.empty() && fields.has(except)) {
    for (const std::string& name : fields.texts(except)) {
      for (const NamedFile& each : matching(fields, except, name, folder, is_one)) left_out.insert(each.file);
    }
  }
  std::map<std::string, fs::path> names;
  std::vector<NamedFile> result;
  for (const std::string& name : fields.texts(field)) {
    for (NamedFile& each : matching(fields, field, name, folder, is_one)) {
      if (left_out.contains(each.file) || !taken.insert(each.file).second) continue;
      const auto [same, is_new] = names.emplace(each.name, each.file);
      if (!is_new) {
        fields.refuse(field, fmt::format("would call {} and {} the same", same->second.string(), each.file.string()),
                      "name them by one pattern that begins above both");
      }
      result.push_back(std::move(each));
    }
  }
  if (result.empty()) fields.refuse(except, "leaves no file", "name fewer");
  return result;
}

fs::path take_file(JsonFields& fields, const std::string& field, const fs::path& folder) {
  const std::string name = fields.text(field);
  std::error_code error;
  fs::path file = absolute_file(folder, name);
  if (!fs::is_regular_file(file, error)) {
    fields.refuse(field, fmt::format("\"{}\" does not exist", name),
                  "name a file relative to the configuration's folder");
  }
  return file;
}

}  // namespace partwise::pipeline
