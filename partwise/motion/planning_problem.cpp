#include "partwise/motion/planning_problem.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <system_error>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/text_scanner.h"
#include "partwise/motion/problem_formats.h"

namespace partwise {
namespace {

// "1, 2.5"
std::string listed(const auto& numbers) {
  std::string text;
  for (const double each : numbers) text += fmt::format("{}{}", text.empty() ? "" : ", ", each);
  return text;
}

}  // namespace

PlanningProblem read_planning_problem(const std::filesystem::path& path, const ProblemFiles& files) {
  const std::string ending = path.extension().string();
  if (equals_ignoring_case(ending, ".env")) return read_env_problem(path, files);
  for (const auto& other : {files.robot, files.query}) {
    if (!other.empty()) throw InputError(other.string(), "goes with an .env file only", "leave it out");
  }
  if (equals_ignoring_case(ending, ".cfg")) return read_cfg_problem(path);
  if (equals_ignoring_case(ending, ".json")) return read_json_problem(path);
  throw InputError(path.string(),
                   ending.empty() ? "has no ending that names a problem format"
                                  : fmt::format("{} is not the ending of a problem format", shown(ending)),
                   "use .cfg, .env or .json");
}

double depth_within(const Eigen::AlignedBox3d& bounds, const std::optional<Sphere>& sphere, SpaceKind kind,
                    const Eigen::Vector3d& point) {
  const int axes = position_axes(kind);
  const double in_box = (point - bounds.min()).cwiseMin(bounds.max() - point).head(axes).minCoeff();
  if (!sphere) return in_box;
  return std::min(in_box, sphere->radius - (point - sphere->centre.transpose()).head(axes).norm());
}

bool within_bounds(const PlanningProblem& problem, const Configuration& q) {
  const double slack = 1e-9 * problem.bounds.sizes().head(position_axes(problem.kind)).norm();
  const auto holds = [&](const Eigen::Vector3d& point) {
    return depth_within(problem.bounds, problem.sphere, problem.kind, point) >= -slack;
  };
  const Eigen::Isometry3d pose = ConfigurationSpace(problem.kind, problem.bounds, 1).pose(q);
  if (!problem.bounds_hold_body || problem.robot.empty()) return holds(pose.translation());
  return std::ranges::all_of(problem.robot, [&](const Mesh& body) {
    for (const auto& vertex : body.vertices.rowwise()) {
      if (!holds(pose * vertex.transpose())) return false;
    }
    return true;
  });
}

Eigen::AlignedBox3d usual_bounds(const PlanningProblem& problem) {
  constexpr double margin = 0.05;  // of the diagonal
  const Eigen::AlignedBox3d box = obstacle_box(problem);
  Eigen::Vector3d wider = Eigen::Vector3d::Constant(margin * box.diagonal().norm());
  if (is_planar(problem.kind)) wider.z() = 0;
  return {box.min() - wider, box.max() + wider};
}

Configuration configuration_of(SpaceKind kind, std::span<const double> numbers, const std::string& place) {
  const auto count = static_cast<std::size_t>(coordinate_count(kind));
  if (numbers.size() != count || !std::ranges::all_of(numbers, [](double each) { return std::isfinite(each); })) {
    throw InputError(place, fmt::format("is not a list of {} numbers", count), "give that many finite ones");
  }
  if (kind == SpaceKind::se2) return planar_configuration_at(numbers[0], numbers[1], numbers[2]);
  Configuration q = Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(count));
  if (kind != SpaceKind::se3) return q;
  const Eigen::Quaterniond rotation(q[3], q[4], q[5], q[6]);
  if (std::abs(rotation.norm() - 1) > 1e-3) {
    throw InputError(place, fmt::format("has a quaternion of length {}", rotation.norm()),
                     "give it length 1 (w x y z)");
  }
  return configuration_at(kind, q.head(3), rotation);
}

void check_problem(const PlanningProblem& problem) {
  const bool is_point = problem.robot.empty();
  const bool turns = problem.kind == SpaceKind::se2 || problem.kind == SpaceKind::se3;
  if (is_point && turns)
    throw InputError("robot", "is missing, but the space has rotations", "give a robot, or take plane or space");
  expect_obstacles(problem, "obstacles");
  if (!problem.footprints.empty() && !(is_point && problem.kind == SpaceKind::plane))
    throw InputError("obstacles", "are footprints, which are for a point in the plane", "give prisms of them");
  if (!problem.obstacles.empty() && is_point && problem.kind == SpaceKind::plane)
    throw InputError("obstacles", "are meshes, for a point in the plane", "give footprints, or a robot");
  expect_room(problem, "bounds");
  for (std::size_t i = 0; i < problem.queries.size(); ++i) {
    const std::string place = fmt::format("queries[{}]", i);
    expect_within_bounds(problem, problem.queries[i].start, place + ".start", "the start");
    expect_within_bounds(problem, problem.queries[i].goal, place + ".goal", "the goal");
  }
}

std::string_view trimmed(std::string_view text) {
  constexpr const char* blanks = " \t\r\n\v\f";
  const std::size_t first = text.find_first_not_of(blanks);
  return first == std::string_view::npos ? "" : text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

double to_number(std::string_view text, const std::string& place, std::string_view what) {
  text = trimmed(text);
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  double value = 0;
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    throw InputError(place, fmt::format("{} is {}, which no double holds", what, shown(text)), "correct it");
  }
  if (error != std::errc() || stop != digits.data() + digits.size()) {
    throw InputError(place, fmt::format("{} is {}, which is not a number", what, shown(text)), "correct it");
  }
  if (!std::isfinite(value)) {
    throw InputError(place, fmt::format("{} is {}, which is not finite", what, shown(text)), "correct it");
  }
  return value;
}

Mesh read_named_mesh(const std::filesystem::path& folder, const std::string& name, const std::string& place) {
  const std::filesystem::path path = folder / name;
  if (equals_ignoring_case(path.extension().string(), ".dae")) {
    throw InputError(place, fmt::format("{} is a COLLADA mesh, which is not read", shown(name)),
                     "convert it to .obj, .stl or .glb and name that");
  }
  std::error_code trouble;  // a name that is too long, say
  if (!std::filesystem::exists(path, trouble)) {
    throw InputError(place, fmt::format("names the mesh {}, which does not exist", shown(name)),
                     "put it there, or correct the name");
  }
  return read_mesh(path);
}

void move_mesh(Mesh& mesh, const Eigen::Isometry3d& pose) {
  mesh.vertices = (mesh.vertices * pose.linear().transpose()).eval();
  mesh.vertices.rowwise() += pose.translation().transpose();
}

Configuration configuration_at(SpaceKind kind, const Eigen::Vector3d& position, const Eigen::Quaterniond& rotation) {
  if (is_planar(kind)) {
    const Eigen::Vector3d ahead = rotation * Eigen::Vector3d::UnitX();
    const Configuration q = planar_configuration_at(position.x(), position.y(), std::atan2(ahead.y(), ahead.x()));
    return kind == SpaceKind::plane ? Configuration(q.head(2)) : q;
  }
  Configuration q(kind == SpaceKind::space ? 3 : 7);
  q.head(3) = position;
  if (kind == SpaceKind::se3) q.tail<4>() = quaternion_coordinates(rotation);
  return q;
}

Configuration planar_configuration_at(double x, double y, double angle) {
  return Configuration{{x, y, wrapped_angle(angle)}};
}

Eigen::AlignedBox3d obstacle_box(const PlanningProblem& problem) {
  Eigen::AlignedBox3d box;
  for (const Mesh& mesh : problem.obstacles) {
    for (const auto& vertex : mesh.vertices.rowwise()) box.extend(vertex.transpose());
  }
  for (const Polygons& polygons : problem.footprints) {
    const Eigen::AlignedBox2d flat = bounding_box(polygons);
    box.extend(Eigen::Vector3d(flat.min().x(), flat.min().y(), 0));
    box.extend(Eigen::Vector3d(flat.max().x(), flat.max().y(), 0));
  }
  if (is_planar(problem.kind)) box.min().z() = box.max().z() = 0;
  return box;
}

void expect_obstacles(const PlanningProblem& problem, const std::string& place) {
  if (problem.obstacles.empty() && problem.footprints.empty()) {
    throw InputError(place, "the world holds no obstacle", "give at least one");
  }
}

void expect_room(const PlanningProblem& problem, const std::string& place) {
  const char* axes[] = {"x", "y", "z"};
  for (int i = 0; i < position_axes(problem.kind); ++i) {
    const double low = problem.bounds.min()[i], high = problem.bounds.max()[i];
    if (!(low < high)) {
      throw InputError(place,
                       fmt::format("the bounds run from {} to {} along {} and leave no room", low, high, axes[i]),
                       "give a lower and a higher number");
    }
  }
}

void expect_within_bounds(const PlanningProblem& problem, const Configuration& q, const std::string& place,
                          std::string_view what) {
  if (within_bounds(problem, q)) return;
  const bool by_body = problem.bounds_hold_body && !problem.robot.empty();
  throw InputError(place,
                   fmt::format("{} at {} {} outside the bounds", what, listed(q.head(position_axes(problem.kind))),
                               by_body ? "has the robot" : "lies"),
                   "move it, or widen the bounds");
}

}  // namespace partwise
