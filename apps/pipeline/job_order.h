// Which jobs come after which others, from the files that they name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "pipeline/job.h"

namespace partwise::pipeline {

// Of each job the places of those that it reads from, which come before it in the list.
// Errors: CheckFailed for two jobs of one name, or one that reads from a later one.
std::vector<std::vector<std::size_t>> jobs_before(const std::vector<Job>& jobs, const std::filesystem::path& output);

}  // namespace partwise::pipeline
