// A planning problem as part of another file. Internal to the project.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "partwise/motion/planning_problem.h"

namespace partwise {

// What read_planning_problem reads from our JSON, from an object at `place` of `file`, whose files are named relative
// to `folder`.
PlanningProblem json_problem_at(const nlohmann::json& object, const std::filesystem::path& file,
                                const std::string& place, const std::filesystem::path& folder);

}  // namespace partwise
