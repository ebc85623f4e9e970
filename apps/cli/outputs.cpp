#include "outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"

namespace partwise::cli {
namespace {

namespace fs = std::filesystem;

// Absolute, without links or dots, so that equal places have equal names.
fs::path final_place(const fs::path& path) {
  std::error_code error;
  fs::path followed = follow_links(fs::absolute(path));
  if (is_written_in_place(followed)) return followed;
  const fs::path place = fs::weakly_canonical(followed, error);
  return error ? followed.lexically_normal() : place;
}

void copy_to_device(const fs::path& from, const fs::path& device) {
  std::ifstream source(from, std::ios::binary);
  errno = 0;
  std::ofstream target(device, std::ios::binary);
  if (fs::file_size(from) > 0) target << source.rdbuf();
  target.close();
  if (!target) {
    throw InputError(device.string(), fmt::format("writing failed ({})", std::strerror(errno)),
                     "free some space or name a file");
  }
}

using Move = std::pair<fs::path, fs::path>;

// Every file under `staging`, with its place under `folder`.
std::vector<Move> moves_into(const fs::path& staging, const fs::path& folder) {
  std::vector<Move> moves;
  for (const fs::directory_entry& item : fs::recursive_directory_iterator(staging)) {
    if (item.is_directory()) continue;
    moves.emplace_back(item.path(), folder / item.path().lexically_relative(staging));
    if (fs::is_directory(moves.back().second)) {
      throw InputError(moves.back().second.string(), "is a folder", "remove it or name another file");
    }
  }
  std::ranges::sort(moves);
  return moves;
}

}  // namespace

std::string lower_ending(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

Outputs::~Outputs() {
  for (const Entry& entry : entries_) {
    std::error_code ignored;
    if (!entry.staging.empty()) fs::remove_all(entry.staging, ignored);
  }
}

void Outputs::refuse_same_file(const Entry& entry) const {
  for (const Entry& other : entries_) {
    if (other.is_input && entry.is_input) continue;  // one file may be read for two purposes
    std::error_code missing;
    if (other.final != entry.final && !fs::equivalent(other.final, entry.final, missing)) continue;
    throw UsageError(fmt::format("{} and {} name the same file, {}", other.option, entry.option, entry.path.string()));
  }
}

void Outputs::add_input(const std::string& option, const fs::path& path) {
  Entry entry{.option = option, .path = path, .is_input = true};
  entry.final = final_place(path);
  refuse_same_file(entry);
  entries_.push_back(std::move(entry));
}

void Outputs::add(const std::string& option, const fs::path& path, const std::vector<std::string>& endings) {
  if (!endings.empty() && std::ranges::find(endings, lower_ending(path)) == endings.end()) {
    std::string allowed = endings.front();
    for (std::size_t i = 1; i < endings.size(); ++i) allowed += " or " + endings[i];
    throw UsageError(fmt::format("{}: {} does not end in {}", option, path.string(), allowed));
  }
  if (!path.has_filename()) throw UsageError(fmt::format("{}: '{}' is not the name of a file", option, path.string()));
  Entry entry{.option = option, .path = path};
  entry.final = final_place(path);
  refuse_same_file(entry);

  std::error_code error;
  if (fs::is_directory(entry.final, error)) {
    throw InputError(path.string(), "is a folder", fmt::format("name a file for {}", option));
  }
  entry.is_device = is_written_in_place(entry.final);
  if (!entry.is_device) {
    const fs::path folder = entry.final.parent_path();
    if (!fs::is_directory(folder, error)) {
      throw InputError(path.string(), fmt::format("there is no folder {}", folder.string()), "make the folder first");
    }
    if (::access(folder.c_str(), W_OK | X_OK) != 0) {
      throw InputError(path.string(), fmt::format("the folder cannot be written ({})", std::strerror(errno)),
                       "name a file in a folder that you may write to");
    }
  }
  entries_.push_back(std::move(entry));
}

fs::path Outputs::staged(const std::string& option) {
  const auto entry = std::ranges::find_if(entries_, [&](const Entry& e) { return !e.is_input && e.option == option; });
  PARTWISE_CHECK((entry != entries_.end()), ==, true);
  if (entry->staging.empty()) {
    const fs::path folder = entry->is_device ? fs::temp_directory_path() : entry->final.parent_path();
    const fs::path staging = folder / fmt::format(".partwise-{}-{}", ::getpid(), entry - entries_.begin());
    std::error_code error;
    fs::create_directory(staging, error);
    if (error) {
      throw InputError(entry->path.string(), fmt::format("the folder cannot be written ({})", error.message()),
                       "name a file in a folder that you may write to");
    }
    entry->staging = staging;
  }
  return entry->staging / entry->final.filename();
}

void Outputs::commit() {
  // What can fail comes first: devices, then targets that are in the way; renaming beside itself is all that is left.
  // What a file brings along is moved before the file that names it.
  std::vector<Move> companions, named;
  for (const Entry& entry : entries_) {
    if (entry.staging.empty()) continue;
    const fs::path staged_file = entry.staging / entry.final.filename();
    if (entry.is_device) {
      copy_to_device(staged_file, entry.final);
      continue;
    }
    for (const Move& move : moves_into(entry.staging, entry.final.parent_path())) {
      (move.first == staged_file ? named : companions).push_back(move);
    }
  }
  for (const Move& move : companions) {
    const auto same = [&](const Entry& entry) { return entry.final == move.second; };
    if (std::ranges::any_of(entries_, same)) {
      throw InputError(move.second.string(), "is asked for and also belongs to another output", "choose another name");
    }
  }
  for (const std::vector<Move>* moves : {&companions, &named}) {
    for (const auto& [from, to] : *moves) {
      std::error_code error;
      fs::create_directories(to.parent_path(), error);
      if (!error) fs::rename(from, to, error);
      if (error) {
        throw InputError(to.string(), fmt::format("cannot be written ({})", error.message()),
                         "name a file in a folder that you may write to");
      }
    }
  }
}

}  // namespace partwise::cli
