// OMPL.app's .cfg: sections in brackets, key = value, comments from #; what [problem] says of meshes, start, goal and
// volume is used, everything else is for its benchmarks. As OMPL.app does it: the problem is one of SE(3) where start
// and goal have z and axis, of SE(2) where they have none of these; the robot's origin is the mean of its vertices (in
// SE(2) only of x and y), which its importer has split where faces meet at an edge; without a volume the bounds are the
// box of the world, widened to hold start and goal.
#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/geometry/text_scanner.h"
#include "partwise/motion/problem_formats.h"

namespace partwise {
namespace {

// The keys of [problem], each with its value and place.
class ProblemSection {
 public:
  ProblemSection(std::string file, std::string_view bytes) : file_(std::move(file)) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    std::string section;
    for (int line = 1; !bytes.empty(); ++line) {
      const std::size_t end = std::min(bytes.find('\n'), bytes.size());
      take(trimmed(bytes.substr(0, std::min(bytes.find('#'), end))), line, section);
      bytes.remove_prefix(std::min(end + 1, bytes.size()));
    }
    if (entries_.empty()) throw InputError(file_, "has no section [problem]", "give a problem file of OMPL.app");
  }

  bool has(const std::string& key) const { return entries_.contains(key); }
  std::string place(const std::string& key) const { return fmt::format("{}:{}", file_, entries_.at(key).line); }

  const std::string& text(const std::string& key) const {
    const auto found = entries_.find(key);
    if (found == entries_.end()) throw InputError(file_, "[problem] has no " + key, "add it");
    if (found->second.value.empty()) throw InputError(place(key), key + " is empty", "give it a value");
    return found->second.value;
  }

  double number(const std::string& key) const {
    const std::string& value = text(key);
    return to_number(value, place(key), key);
  }

 private:
  struct Entry {
    std::string value;
    int line;
  };

  void take(std::string_view text, int line, std::string& section) {
    if (text.empty()) return;
    const std::string place = fmt::format("{}:{}", file_, line);
    if (text.front() == '[' && text.back() == ']') {
      section = std::string(trimmed(text.substr(1, text.size() - 2))) + ".";
      return;
    }
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos) {
      throw InputError(place, fmt::format("{} is neither [section] nor key = value", shown(text)), "correct the line");
    }
    constexpr std::string_view wanted = "problem.";
    const std::string key = section + std::string(trimmed(text.substr(0, equals)));
    if (!key.starts_with(wanted)) return;
    const std::string name = key.substr(wanted.size());
    if (!entries_.try_emplace(name, Entry{std::string(trimmed(text.substr(equals + 1))), line}).second) {
      throw InputError(place, fmt::format("{} is there twice", shown(name)), "keep one");
    }
  }

  std::string file_;
  std::map<std::string, Entry> entries_;
};

// The mean of the places and the directions of faces that come together there, each such pair once: what a mesh
// importer makes of a mesh without normals, whose corners it shades flat and then joins where they are equal.
Point flat_shaded_mean(const Mesh& mesh) {
  constexpr double same = 1e-5;  // difference of unit normals, as the importer has it
  std::map<std::array<double, 3>, std::vector<Eigen::Vector3d>> normals;
  Point sum = Point::Zero();
  int count = 0;
  for (const auto& face : mesh.faces.rowwise()) {
    const Eigen::Vector3d a = mesh.vertices.row(face[0]), b = mesh.vertices.row(face[1]),
                          c = mesh.vertices.row(face[2]);
    const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
    for (const Eigen::Vector3d& corner : {a, b, c}) {
      auto& there = normals[{corner.x(), corner.y(), corner.z()}];
      if (std::ranges::any_of(there, [&](const auto& each) { return (each - normal).norm() <= same; })) continue;
      there.push_back(normal);
      sum += corner.transpose();
      ++count;
    }
  }
  return sum / count;
}

SpaceKind kind_of(const ProblemSection& section, const std::string& file) {
  constexpr std::array spatial = {"start.z", "start.axis.x", "start.axis.y", "start.axis.z",
                                  "goal.z",  "goal.axis.x",  "goal.axis.y",  "goal.axis.z"};
  const char *present = nullptr, *missing = nullptr;
  for (const char* key : spatial) (section.has(key) ? present : missing) = key;
  if (present != nullptr && missing != nullptr) {
    throw InputError(file, fmt::format("[problem] has {} but no {}", present, missing),
                     "SE(3) needs z and axis of start and goal, SE(2) none of them");
  }
  return present != nullptr ? SpaceKind::se3 : SpaceKind::se2;
}

Configuration configuration(const ProblemSection& section, SpaceKind kind, const std::string& end) {
  const auto number = [&](const char* key) { return section.number(end + key); };
  const double x = number(".x"), y = number(".y"), theta = number(".theta");
  if (kind == SpaceKind::se2) return planar_configuration_at(x, y, theta);
  const Eigen::Vector3d position(x, y, number(".z")), axis(number(".axis.x"), number(".axis.y"), number(".axis.z"));
  if (axis.norm() < 1e-12 && theta != 0) {
    throw InputError(section.place(end + ".axis.x"), end + " turns about an axis of no length", "give it a direction");
  }
  return configuration_at(kind, position, Eigen::Quaterniond(Eigen::AngleAxisd(theta, axis.stableNormalized())));
}

void set_bounds(const ProblemSection& section, PlanningProblem& problem) {
  const int axes = problem.kind == SpaceKind::se2 ? 2 : 3;
  constexpr std::array letters = {"x", "y", "z"};
  bool any = false;
  for (const char* letter : letters) {
    any = any || section.has(std::string("volume.min.") + letter) || section.has(std::string("volume.max.") + letter);
  }
  if (any) {
    problem.bounds = Eigen::AlignedBox3d(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero());
    for (int i = 0; i < axes; ++i) {
      problem.bounds.min()[i] = section.number(std::string("volume.min.") + letters[i]);
      problem.bounds.max()[i] = section.number(std::string("volume.max.") + letters[i]);
    }
    return;
  }
  problem.bounds = obstacle_box(problem);
  for (const Configuration& q : {problem.queries[0].start, problem.queries[0].goal}) {
    problem.bounds.extend(Eigen::Vector3d(q[0], q[1], axes == 2 ? 0 : q[2]));
  }
}

}  // namespace

PlanningProblem read_cfg_problem(const std::filesystem::path& path) {
  const std::string file = path.string();
  const ProblemSection section(file, read_bytes(path));
  if (section.has("control")) {
    throw InputError(
        section.place("control"),
        fmt::format("motion under differential constraints ({}) is not supported", shown(section.text("control"))),
        "remove the line to plan for the geometry alone");
  }
  PlanningProblem problem;
  problem.name = section.has("name") ? section.text("name") : path.stem().string();
  problem.kind = kind_of(section, file);
  problem.queries = {{configuration(section, problem.kind, "start"), configuration(section, problem.kind, "goal")}};
  const auto mesh = [&](const std::string& key) {
    const std::string& name = section.text(key);
    return read_named_mesh(path.parent_path(), name, section.place(key));
  };
  problem.obstacles.push_back(mesh("world"));
  problem.robot.push_back(mesh("robot"));
  Point centre = flat_shaded_mean(problem.robot[0]);
  if (problem.kind == SpaceKind::se2) centre.z() = 0;
  problem.robot[0].vertices.rowwise() -= centre;

  set_bounds(section, problem);
  expect_room(problem, file);
  for (const MotionQuery& query : problem.queries) {
    expect_within_bounds(problem, query.start, section.place("start.x"), "the start");
    expect_within_bounds(problem, query.goal, section.place("goal.x"), "the goal");
  }
  return problem;
}

}  // namespace partwise
