#include "pipeline/pipeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "pipeline/early_check.h"
#include "pipeline/output_lock.h"

namespace partwise::pipeline {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using State = JobResult::State;

constexpr const char* manifest_name = "manifest.json";

void make_output_folder(const fs::path& output) {
  std::error_code error;
  fs::create_directories(output, error);
  if (error || !fs::is_directory(output)) {
    throw InputError(output.string(), fmt::format("cannot be made ({})", error ? error.message() : "a file is there"),
                     "name a folder that you may write to");
  }
}

// A shape whose parts fail may be left out; nothing else may be missing.
bool may_fail(const Plan& plan, const Job& job) { return plan.leave_out_bad && job.name.starts_with("parts/"); }

std::vector<StageReport> by_stage(const Plan& plan, const std::vector<JobResult>& results) {
  std::vector<StageReport> stages;
  for (const std::string& name : plan.stages) stages.push_back({.name = name});
  for (std::size_t i = 0; i < results.size(); ++i) {
    StageReport& stage = *std::ranges::find(stages, plan.jobs[i].stage, &StageReport::name);
    ++stage.jobs;
    stage.made += results[i].state == State::made ? 1 : 0;
    stage.kept += results[i].state == State::kept ? 1 : 0;
    stage.failed += results[i].state == State::failed ? 1 : 0;
    stage.held += results[i].state == State::held ? 1 : 0;
    stage.seconds += results[i].seconds;
  }
  return stages;
}

void write_manifest(const Plan& plan, const std::string& version, const std::vector<JobResult>& results) {
  Json stages = Json::array(), left_out = Json::array();
  for (const std::string& name : plan.stages) stages.push_back({{"name", name}, {"jobs", Json::array()}});
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].state == State::failed) {
      left_out.push_back({{"job", plan.jobs[i].name}, {"why", results[i].message}});
      continue;
    }
    Json job = {{"name", plan.jobs[i].name}};
    job.update(as_json(results[i].record));
    const auto stage = std::ranges::find(plan.stages, plan.jobs[i].stage) - plan.stages.begin();
    stages[static_cast<std::size_t>(stage)]["jobs"].push_back(std::move(job));
  }
  const Json manifest = {{"partwise", version}, {"stages", stages}, {"left_out", left_out}};
  write_file(plan.output / manifest_name, manifest.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

PipelineReport run_pipeline(const Plan& plan, const PipelineSettings& settings,
                            const std::function<void(const std::string& line)>& say, const Progress& progress) {
  make_output_folder(plan.output);
  const OutputLock lock(plan.output);
  check_early(plan, settings.program, progress);
  FileHashes hashes(plan.output / ".hashes");
  const Workplace place{plan.output, settings.program, settings.version};
  JobEvents events;
  const auto remove_manifest = [&] {
    std::error_code none;
    fs::remove(plan.output / manifest_name, none);
  };
  events.begins = [&](const Job&) { remove_manifest(); };  // from here on the old one is not true any more
  events.fails = [&](const Job& job, const std::string& message) { say(job.name + ": " + message); };
  std::vector<JobResult> results;
  try {
    results = run_jobs(place, plan.jobs, settings.threads, hashes, events, progress);
  } catch (const Cancelled&) {
    hashes.save();
    throw;
  }
  hashes.save();
  PipelineReport report{.stages = by_stage(plan, results), .whole = true};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const bool is_there = results[i].state == State::made || results[i].state == State::kept;
    const bool may_miss = results[i].state == State::failed && may_fail(plan, plan.jobs[i]);
    report.whole = report.whole && (is_there || may_miss);
  }
  if (report.whole) {
    write_manifest(plan, settings.version, results);
  } else {
    remove_manifest();
  }
  return report;
}

std::vector<JobForecast> forecast_pipeline(const Plan& plan, const PipelineSettings& settings) {
  FileHashes hashes(plan.output / ".hashes");
  return forecast_jobs({plan.output, settings.program, settings.version}, plan.jobs, hashes);
}

}  // namespace partwise::pipeline
