// A pipeline run to its end: jobs made or kept, what came of each stage, and the manifest of what was made from what.
//
// manifest.json in the output folder is there when all that was asked for is, and only then. One pipeline works in an
// output folder at a time.
//
// Errors: InputError for an output folder that cannot be made or is in use; Cancelled.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "pipeline/job_runner.h"
#include "pipeline/plan.h"

namespace partwise::pipeline {

struct PipelineSettings {
  std::filesystem::path program;  // partwise, which the jobs run
  std::string version;            // its version
  int threads = 1;
};

struct StageReport {
  std::string name;
  int jobs = 0, made = 0, kept = 0, failed = 0;
  int held = 0;        // need one that failed
  double seconds = 0;  // of the jobs that were made, summed
};

struct PipelineReport {
  std::vector<StageReport> stages;
  bool whole = false;  // all is there that is wanted
};

PipelineReport run_pipeline(const Plan& plan, const PipelineSettings& settings,
                            const std::function<void(const std::string& line)>& say, const Progress& progress);

// What it would do, a line a job.
std::vector<JobForecast> forecast_pipeline(const Plan& plan, const PipelineSettings& settings);

}  // namespace partwise::pipeline
