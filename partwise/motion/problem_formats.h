// One reader a format of problem files behind planning_problem.h, and what they share.
#pragma once

#include <string>
#include <string_view>

#include "partwise/motion/planning_problem.h"

namespace partwise {

PlanningProblem read_cfg_problem(const std::filesystem::path& path);
PlanningProblem read_env_problem(const std::filesystem::path& path, const ProblemFiles& files);
PlanningProblem read_json_problem(const std::filesystem::path& path);

// Without the blanks at both ends.
std::string_view trimmed(std::string_view text);

// A finite number, blanks around it allowed. `what` names it in the message.
double to_number(std::string_view text, const std::string& place, std::string_view what);

// A mesh that a problem file names, relative to its folder. `place` is where it does.
Mesh read_named_mesh(const std::filesystem::path& folder, const std::string& name, const std::string& place);

void move_mesh(Mesh& mesh, const Eigen::Isometry3d& pose);

// Of the kind's coordinates, normalised: angles in [-pi, pi), quaternions of unit length with w >= 0. What a kind has
// no coordinates for is dropped.
Configuration configuration_at(SpaceKind kind, const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation);
Configuration planar_configuration_at(double x, double y, double angle);

// Around all obstacles; z is 0 in the plane.
Eigen::AlignedBox3d obstacle_box(const PlanningProblem& problem);

// Throws InputError at `place`: without an obstacle; where the bounds leave no room; outside of them. `what` is "the
// start", say.
void expect_obstacles(const PlanningProblem& problem, const std::string& place);
void expect_room(const PlanningProblem& problem, const std::string& place);
void expect_within_bounds(const PlanningProblem& problem, const Configuration& q, const std::string& place,
                          std::string_view what);

}  // namespace partwise
