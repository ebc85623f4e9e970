// Configurations of verbs that cannot be looked at without running them, such as those that need libtorch: what is
// wrong is said before anything is made, by the verb's own --check.
//
// Errors: InputError that names the pipeline's configuration and the place in it; Cancelled.
#pragma once

#include <filesystem>

#include "partwise/base/progress.h"
#include "pipeline/plan.h"

namespace partwise::pipeline {

// Of the jobs that ask for it. One that was made from the same configuration before is not looked at again.
void check_early(const Plan& plan, const std::filesystem::path& program, const Progress& progress);

}  // namespace partwise::pipeline
