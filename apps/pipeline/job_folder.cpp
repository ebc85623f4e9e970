#include "pipeline/job_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/shared_files.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int format = 1;  // of folders and records; another one makes everything anew
constexpr std::string_view shipped_mark = "partwise:";

bool lies_in(const fs::path& file, const fs::path& folder) {
  return std::ranges::mismatch(folder, file).in1 == folder.end();
}

// The folder that holds the shipped data/ and models/.
fs::path shipped_folder() {
  std::error_code error;
  return fs::weakly_canonical(shared_file("models").parent_path(), error);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError(folder.string(), fmt::format("cannot be made ({})", error.message()),
                     "name an output folder that you may write to");
  }
}

void remove_folder(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (error) {
    throw InputError(folder.string(), fmt::format("cannot be removed ({})", error.message()), "remove it by hand");
  }
}

void move_folder(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) {
    throw InputError(to.string(), fmt::format("cannot be put in its place ({})", error.message()),
                     "name an output folder that you may write to");
  }
}

// Files that someone who was killed was writing.
void remove_rests(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> rests;
  for (const fs::directory_entry& each : fs::recursive_directory_iterator(folder, error)) {
    if (each.path().extension() == ".tmp") rests.push_back(each.path());
  }
  for (const fs::path& each : rests) fs::remove(each, error);
}

bool is_accessory(const Job& job, const std::string& name) {
  return name == record_name ||
         std::ranges::any_of(job.accessories, [&](const std::string& each) { return name.starts_with(each); });
}

}  // namespace

JobFolder::JobFolder(const Workplace& place, const Job& job, FileHashes& hashes)
    : place_(place),
      job_(job),
      hashes_(hashes),
      folder_(place.output / job.name),
      unfinished_(folder_.string() + ".unfinished"),
      shipped_(shipped_folder()) {
  for (const fs::path& input : job.inputs) add_input(input);
  record_.partwise = place.version;
  record_.words = command(folder_, place.output);
  Json given = Json::array();
  for (const GivenFile& each : job.given) given.push_back({each.name, each.text});
  record_.asked = hash_of(Json{format, place.version, record_.words, job.threads, given}.dump());
  const std::optional<JobRecord> before = read_record(folder_);
  reason_ = before ? why_not(*before) : "it is not there";
  if (reason_.empty()) record_ = *before;
}

fs::path JobFolder::file_named(const std::string& name) const {
  return name.starts_with(shipped_mark) ? shipped_ / name.substr(shipped_mark.size()) : place_.output / name;
}

std::string JobFolder::name_of(const fs::path& file) const { return file.lexically_relative(place_.output).string(); }

// What nobody named is the verb's own affair: materials, lights and networks that ship.
std::string JobFolder::name_of_read(const fs::path& file) const {
  std::string name = name_of(file);
  if (inputs_.contains(name) || !lies_in(file, shipped_) || lies_in(file, place_.output)) return name;
  const fs::path within = file.lexically_relative(shipped_);
  if (*within.begin() == "models" || *within.begin() == "data") return std::string(shipped_mark) + within.string();
  return name;
}

// A file, or all that another job left.
void JobFolder::add_input(const fs::path& input) {
  std::error_code error;
  if (!fs::is_directory(input, error)) {
    inputs_.insert_or_assign(name_of(input), hashes_.of(input));
    return;
  }
  const std::optional<JobRecord> made = read_record(input);
  if (!made) throw InputError(input.string(), "is no folder of a finished job", "remove it");
  for (const FileState& each : made->outputs) inputs_.insert_or_assign(each.name, each.hash);
}

std::string JobFolder::why_not(const JobRecord& before) {
  if (before.partwise != record_.partwise) return fmt::format("partwise {} made it", before.partwise);
  if (before.asked != record_.asked) return "it is asked for in another way";
  if (before.outputs.empty()) return "it is not finished";
  std::error_code error;
  std::map<std::string, std::string> read;
  for (const FileState& each : before.inputs) {
    read[each.name] = each.hash;
    const auto known = inputs_.find(each.name);
    if (known == inputs_.end() && !fs::is_regular_file(file_named(each.name), error)) return each.name + " is gone";
    if ((known == inputs_.end() ? hashes_.of(file_named(each.name)) : known->second) != each.hash) {
      return each.name + " has changed";
    }
  }
  for (const auto& [name, hash] : inputs_) {
    if (!read.contains(name)) return name + " is new";
  }
  for (const FileState& each : before.outputs) {
    const fs::path file = place_.output / each.name;
    if (!fs::is_regular_file(file, error)) return each.name + " is gone";
    if (hashes_.of(file) != each.hash) return each.name + " was changed";
  }
  return "";
}

std::vector<std::string> JobFolder::command(const fs::path& folder, const fs::path& from) const {
  const auto shown = [&](const fs::path& file) {
    const std::string relative = file.lexically_relative(from).string();
    return relative.empty() ? file.string() : relative;
  };
  std::vector<std::string> words;
  for (const Word& word : job_.words) {
    if (word.kind == Word::Kind::plain) words.push_back(word.text);
    if (word.kind == Word::Kind::input) words.push_back(shown(word.text));
    if (word.kind == Word::Kind::output) words.push_back(shown(word.text == "." ? folder : folder / word.text));
  }
  return words;
}

std::vector<std::string> JobFolder::begin(const fs::path& from) {
  record_.inputs.clear();
  for (const auto& [name, hash] : inputs_) record_.inputs.push_back({name, hash});
  const std::optional<JobRecord> begun = read_record(unfinished_);
  remove_rests(unfinished_);
  if (!job_.goes_on || !begun || begun->asked != record_.asked || begun->inputs != record_.inputs) {
    remove_folder(unfinished_);
    make_folder(unfinished_);
    for (const GivenFile& each : job_.given) write_file(unfinished_ / each.name, each.text);
    write_record(unfinished_, record_);
  }
  began_ = fs::file_time_type::clock::now();
  return command(unfinished_, from);
}

void JobFolder::expect_unchanged(const fs::path& file) const {
  std::error_code error;
  if (fs::last_write_time(file, error) > began_ || error) {
    throw InputError(file.string(), "changed while it was read", "run the pipeline again");
  }
}

void JobFolder::finish(const fs::path& from, double seconds) {
  record_.report = Json::parse(read_bytes(report()), nullptr, false);
  PARTWISE_CHECK(record_.report.is_object(), ==, true);
  fs::remove(report());
  // What the verb read beyond what is known: files named in files, and what ships.
  std::vector<fs::path> read;
  for (const Json& each : record_.report.value("reads", Json::array())) {
    const fs::path named = from / each.get<std::string>();
    read.push_back(fs::weakly_canonical(named.parent_path()) / named.filename());
  }
  for (const auto& [name, hash] : inputs_) expect_unchanged(file_named(name));
  for (const fs::path& file : read) {
    if (lies_in(file, unfinished_)) continue;
    expect_unchanged(file);
    inputs_.insert_or_assign(name_of_read(file), hashes_.of(file));
  }
  record_.inputs.clear();
  for (const auto& [name, hash] : inputs_) record_.inputs.push_back({name, hash});
  for (const char* name : {"reads", "seconds", "input", "output", "files"}) record_.report.erase(name);
  for (const std::string& name : job_.outputs) {
    if (!fs::is_regular_file(unfinished_ / name)) throw InputError(job_.name, "lacks " + name, "report this mistake");
  }
  record_.outputs.clear();
  for (const fs::directory_entry& each : fs::recursive_directory_iterator(unfinished_)) {
    const std::string name = each.path().lexically_relative(unfinished_).string();
    if (!each.is_regular_file() || is_accessory(job_, name)) continue;
    record_.outputs.push_back({(fs::path(job_.name) / name).string(), hashes_.of(each.path())});
  }
  std::ranges::sort(record_.outputs, {}, &FileState::name);
  record_.seconds = seconds;
  write_record(unfinished_, record_);
  const fs::path old = folder_.string() + ".old";
  remove_folder(old);
  if (fs::exists(folder_)) move_folder(folder_, old);
  move_folder(unfinished_, folder_);
  remove_folder(old);
}

void JobFolder::give_up() {
  std::error_code error;
  fs::remove(report(), error);
  if (!job_.goes_on) fs::remove_all(unfinished_, error);
}

}  // namespace partwise::pipeline
