// Runs jobs: those whose outputs stand are kept, the others are made, several at a time, each after those that it reads
// from. A job that fails holds up those that need it and no others.
//
// `threads` are shared out: narrow jobs run side by side, wide ones alone. Which jobs run side by side has no influence
// on what they leave. A stop (Progress) is passed on to what runs, and waited for; what was made until then is kept.
//
// Errors: Cancelled. What goes wrong with a job is its result.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "pipeline/job.h"
#include "pipeline/job_folder.h"

namespace partwise::pipeline {

struct JobResult {
  enum class State {
    kept,
    made,
    failed,
    held,  // needs one that failed
  };

  State state = State::held;
  std::string message;  // of failed ones one line; of held ones the name of the job that they need
  double seconds = 0;   // of made and failed ones
  JobRecord record;     // of kept and made ones
};

// Whoever wants to hear of jobs as they come.
struct JobEvents {
  std::function<void(const Job& job)> begins;
  std::function<void(const Job& job, const std::string& message)> fails;
};

std::vector<JobResult> run_jobs(const Workplace& place, const std::vector<Job>& jobs, int threads, FileHashes& hashes,
                                const JobEvents& events, const Progress& progress);

// What run_jobs would do, without doing it.
struct JobForecast {
  enum class State {
    kept,
    made,
    open,  // depends on what those will be that it reads from
  };

  State state = State::open;
  std::string reason;  // of made ones; of open ones the name of the job
};
std::vector<JobForecast> forecast_jobs(const Workplace& place, const std::vector<Job>& jobs, FileHashes& hashes);

}  // namespace partwise::pipeline
