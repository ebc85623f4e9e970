// All that a configuration asks for (docs/pipeline.md), as jobs in the order of their stages.
//
// Errors: InputError with the file and the field's place, for what is missing, wrong or unknown, before anything is
// made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/job.h"

namespace partwise::pipeline {

struct Plan {
  std::filesystem::path config;  // as it was named
  std::filesystem::path output;  // canonical
  std::vector<std::string> stages;
  std::vector<Job> jobs;
  bool leave_out_bad = false;  // shapes whose parts fail are left out of what comes after
};

// `output` and `seed` go before those of the configuration, unless empty or 0.
Plan read_plan(const std::filesystem::path& config, const std::filesystem::path& output, int seed);

}  // namespace partwise::pipeline
