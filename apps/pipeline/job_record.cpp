#include "pipeline/job_record.h"

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "pipeline/file_hashes.h"

namespace partwise::pipeline {
namespace {

using Json = nlohmann::ordered_json;

Json states(const std::vector<FileState>& files) {
  Json list = Json::array();
  for (const FileState& each : files) list.push_back({{"file", each.name}, {"hash", each.hash}});
  return list;
}

std::vector<FileState> states_of(const Json& list) {
  std::vector<FileState> files;
  for (const Json& each : list) files.push_back({each.at("file"), each.at("hash")});
  return files;
}

std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string JobRecord::key() const { return hash_of(Json{{"asked", asked}, {"inputs", states(inputs)}}.dump()); }

Json as_json(const JobRecord& record) {
  return {{"key", record.key()},       {"partwise", record.partwise},     {"asked", record.asked},
          {"command", record.words},   {"inputs", states(record.inputs)}, {"outputs", states(record.outputs)},
          {"seconds", record.seconds}, {"report", record.report}};
}

std::optional<JobRecord> read_record(const std::filesystem::path& folder) {
  try {
    const Json json = Json::parse(read_bytes(folder / record_name));
    JobRecord record;
    record.partwise = json.at("partwise");
    record.asked = json.at("asked");
    record.words = json.at("command").get<std::vector<std::string>>();
    record.inputs = states_of(json.at("inputs"));
    record.outputs = states_of(json.at("outputs"));
    record.seconds = json.at("seconds");
    record.report = json.at("report");
    return record;
  } catch (const InputError&) {
  } catch (const Json::exception&) {
  }
  return std::nullopt;
}

void write_record(const std::filesystem::path& folder, const JobRecord& record) {
  write_file(folder / record_name, text_of(as_json(record)));
}

}  // namespace partwise::pipeline
