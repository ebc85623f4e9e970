// Parasol's .env: a boundary, optional resolutions, and multibodies, of which one may be the robot (Active, the older
// way); else the robot is in a .robot file. A .query file holds configurations a line, the robot's number (0) before
// its coordinates: x y [z], then of what rotates angles in units of pi, about z, or about x, y and z, all about fixed
// axes (R = Rz Ry Rx). Each configuration after the first is a goal whose start is the one before.
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <system_error>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/motion/parasol_bodies.h"
#include "partwise/motion/problem_formats.h"

namespace partwise {
namespace {

using Eigen::AngleAxisd, Eigen::Vector3d;

// What stands between the next brackets, which may be on several lines.
std::string bracketed(TextScanner& scanner) {
  std::string_view token = scanner.token();
  if (!token.starts_with('[')) scanner.fail(fmt::format("{} stands where '[' should be", shown(token)), "correct it");
  std::string text(token.substr(1));
  while (text.find(']') == std::string::npos) {
    token = scanner.token();
    if (token.empty()) scanner.fail("the boundary has no ']'", "close it; the file may have been cut short");
    text += ' ';
    text += token;
  }
  return text.substr(0, text.find(']'));
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(separators, from), text.size());
    parts.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return parts;
}

struct Boundary {
  int dimension = 3;
  Eigen::AlignedBox3d box = Eigen::AlignedBox3d(Vector3d::Zero(), Vector3d::Zero());
  std::optional<Sphere> sphere;
  std::string place;
};

void read_box(Boundary& boundary, std::string_view text) {
  const std::vector<std::string_view> ranges = split(text, ";");
  if (static_cast<int>(ranges.size()) != boundary.dimension) {
    throw InputError(boundary.place,
                     fmt::format("the box has {} ranges instead of {}", ranges.size(), boundary.dimension),
                     "write [x0:x1 ; y0:y1 ; z0:z1], or Box2D [x0:x1 ; y0:y1]");
  }
  for (int i = 0; i < boundary.dimension; ++i) {
    const std::vector<std::string_view> ends = split(ranges[static_cast<std::size_t>(i)], ":");
    if (ends.size() != 2) {
      throw InputError(boundary.place,
                       fmt::format("{} is not a range", shown(trimmed(ranges[static_cast<std::size_t>(i)]))),
                       "write low:high");
    }
    boundary.box.min()[i] = to_number(ends[0], boundary.place, "a bound");
    boundary.box.max()[i] = to_number(ends[1], boundary.place, "a bound");
  }
}

void read_sphere(Boundary& boundary, std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view each : split(text, " ;")) {
    if (!trimmed(each).empty()) numbers.push_back(to_number(each, boundary.place, "a number of the sphere"));
  }
  const auto dimension = static_cast<std::size_t>(boundary.dimension);
  if (numbers.size() != dimension + 1) {
    throw InputError(boundary.place,
                     fmt::format("the sphere has {} numbers instead of {}", numbers.size(), dimension + 1),
                     "write [x y z ; radius], or Sphere2D [x y ; radius]");
  }
  const double radius = numbers.back();
  if (!(radius > 0)) throw InputError(boundary.place, fmt::format("the radius is {}", radius), "give one above 0");
  boundary.sphere = Sphere{{numbers[0], numbers[1], dimension == 3 ? numbers[2] : 0.0}, radius};
  const Vector3d centre = boundary.sphere->centre.transpose(), half(radius, radius, dimension == 3 ? radius : 0);
  boundary.box = Eigen::AlignedBox3d(centre - half, centre + half);
}

Boundary read_boundary(TextScanner& scanner) {
  std::string_view word = scanner.token();
  if (word.empty()) throw InputError(scanner.file(), "is empty", "give an environment of Parasol's");
  if (!equals_ignoring_case(word, "boundary")) {
    scanner.fail(fmt::format("begins with {} instead of Boundary", shown(word)), "give an environment of Parasol's");
  }
  Boundary boundary;
  word = scanner.token();
  boundary.place = scanner.place();
  const bool flat_box = equals_ignoring_case(word, "box2d"), flat_sphere = equals_ignoring_case(word, "sphere2d");
  const bool box = flat_box || equals_ignoring_case(word, "box");
  if (!box && !flat_sphere && !equals_ignoring_case(word, "sphere")) {
    scanner.fail(fmt::format("{} is not a boundary", shown(word)), "use Box, Box2D, Sphere or Sphere2D");
  }
  boundary.dimension = flat_box || flat_sphere ? 2 : 3;
  const std::string text = bracketed(scanner);
  box ? read_box(boundary, text) : read_sphere(boundary, text);
  return boundary;
}

// Passes the resolutions, which are a collision checker's affair, and the word Multibodies.
std::int64_t read_multibody_count(TextScanner& scanner) {
  constexpr std::array resolutions = {"positionres", "positionresfactor", "orientation", "orientationres", "rdres",
                                      "timeres"};
  for (;;) {
    const std::string_view word = scanner.token();
    if (word.empty()) scanner.fail("the file ends where 'Multibodies' should be", "it was cut short: copy it again");
    if (equals_ignoring_case(word, "multibodies")) return scanner.integer("the number of multibodies");
    if (std::ranges::none_of(resolutions, [&](const char* each) { return equals_ignoring_case(word, each); })) {
      scanner.fail(fmt::format("{} stands where 'Multibodies' should be", shown(word)), "correct the line");
    }
    scanner.coordinate("a resolution");
  }
}

// The file of that ending that belongs to `path`; empty when there is none, or several and none of the same stem.
std::filesystem::path file_beside(const std::filesystem::path& path, const std::string& ending) {
  std::filesystem::path same = path;
  same.replace_extension(ending);
  std::error_code trouble;
  if (std::filesystem::exists(same, trouble)) return same;
  std::filesystem::path only;
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  for (const auto& entry : std::filesystem::directory_iterator(folder, trouble)) {
    if (entry.path().extension() != ending) continue;
    if (!only.empty()) return {};
    only = path.parent_path() / entry.path().filename();
  }
  return only;
}

void read_world(TextScanner& scanner, const std::filesystem::path& folder, PlanningProblem& problem,
                std::optional<ParasolRobot>& robot) {
  const std::int64_t count = read_multibody_count(scanner);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string_view word = scanner.token();
    if (equals_ignoring_case(word, "passive")) {
      problem.obstacles.push_back(read_parasol_obstacle(scanner, folder));
    } else if (equals_ignoring_case(word, "active")) {
      if (robot) scanner.fail("is a second Active body, and several robots are not supported", "leave one");
      robot = read_parasol_robot(scanner, folder);
    } else if (word.empty()) {
      scanner.fail(fmt::format("{} multibodies are announced, the file ends after {}", count, i),
                   "correct the number; the file may have been cut short");
    } else {
      scanner.fail(fmt::format("{} is not a kind of multibody that is supported", shown(word)),
                   "use Active or Passive");
    }
  }
  if (!scanner.at_end()) {
    scanner.token();
    scanner.fail(fmt::format("goes on after its {} multibodies", count), "correct the number, or remove the rest");
  }
}

ParasolRobot read_robot_file(const std::filesystem::path& env, const std::filesystem::path& named) {
  const std::filesystem::path path = named.empty() ? file_beside(env, ".robot") : named;
  if (path.empty()) {
    throw InputError(env.string(), "has no Active body, and there is not one .robot file beside it to tell the robot",
                     "name the .robot file");
  }
  const std::string bytes = read_bytes(path);
  TextScanner scanner(path.string(), bytes, '#');
  ParasolRobot robot = read_parasol_robot(scanner, path.parent_path());
  if (!scanner.at_end()) {
    scanner.token();
    scanner.fail("goes on after the robot's connections", "correct their number, or remove the rest");
  }
  return robot;
}

Configuration read_configuration(TextScanner& scanner, SpaceKind kind) {
  if (scanner.integer("the number of the robot") != 0)
    scanner.fail("several robots are not supported", "plan for number 0");
  const std::size_t wanted = kind == SpaceKind::plane ? 2 : kind == SpaceKind::se3 ? 6 : 3;
  std::vector<double> numbers;
  while (!scanner.at_line_end()) numbers.push_back(scanner.coordinate("a coordinate"));
  if (numbers.size() != wanted) {
    scanner.fail(fmt::format("a configuration has {} coordinates after the robot's number, this robot has {}",
                             numbers.size(), wanted),
                 "correct the line");
  }
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  if (kind == SpaceKind::se3) {
    rotation = AngleAxisd(std::numbers::pi * numbers[5], Vector3d::UnitZ()) *
               AngleAxisd(std::numbers::pi * numbers[4], Vector3d::UnitY()) *
               AngleAxisd(std::numbers::pi * numbers[3], Vector3d::UnitX());
  }
  if (kind == SpaceKind::se2) return planar_configuration_at(numbers[0], numbers[1], std::numbers::pi * numbers[2]);
  return configuration_at(kind, {numbers[0], numbers[1], is_planar(kind) ? 0 : numbers[2]}, rotation);
}

void read_queries(const std::filesystem::path& path, PlanningProblem& problem) {
  const std::string bytes = read_bytes(path);
  TextScanner scanner(path.string(), bytes, '#');
  std::vector<Configuration> way;
  while (!scanner.at_end()) {
    way.push_back(read_configuration(scanner, problem.kind));
    expect_within_bounds(problem, way.back(), scanner.place(), way.size() == 1 ? "the start" : "a goal");
  }
  if (way.size() < 2) {
    throw InputError(path.string(), way.empty() ? "has no start" : "has a start, but no goal",
                     "give both, a line each");
  }
  for (std::size_t i = 1; i < way.size(); ++i) problem.queries.push_back({way[i - 1], way[i]});
}

}  // namespace

PlanningProblem read_env_problem(const std::filesystem::path& path, const ProblemFiles& files) {
  const std::string bytes = read_bytes(path);
  TextScanner scanner(path.string(), bytes, '#');
  PlanningProblem problem;
  problem.name = path.stem().string();
  problem.bounds_hold_body = true;
  const Boundary boundary = read_boundary(scanner);
  problem.bounds = boundary.box;
  problem.sphere = boundary.sphere;
  std::optional<ParasolRobot> robot;
  read_world(scanner, path.parent_path(), problem, robot);
  if (robot && !files.robot.empty()) {
    throw InputError(files.robot.string(), "is a second robot beside the Active body of " + path.string(),
                     "leave it out");
  }
  if (!robot) robot = read_robot_file(path, files.robot);
  problem.kind = robot->kind;
  problem.robot = std::move(robot->bodies);
  expect_obstacles(problem, path.string());
  if (is_planar(problem.kind)) {
    problem.bounds.min().z() = problem.bounds.max().z() = 0;
    if (problem.sphere) problem.sphere->centre.z() = 0;
  } else if (boundary.dimension == 2) {
    throw InputError(boundary.place, "the boundary has no z, which a volumetric robot needs", "use Box or Sphere");
  }
  expect_room(problem, boundary.place);
  const std::filesystem::path query = files.query.empty() ? file_beside(path, ".query") : files.query;
  if (!query.empty()) read_queries(query, problem);
  return problem;
}

}  // namespace partwise
