#include "partwise/motion/parasol_bodies.h"

#include <algorithm>
#include <cctype>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/motion/problem_formats.h"

namespace partwise {
namespace {

using Eigen::AngleAxisd, Eigen::Isometry3d, Eigen::Translation3d, Eigen::Vector3d;

enum class BodyKind { planar, volumetric, fixed, joint };

struct Body {
  Mesh mesh;
  BodyKind kind = BodyKind::fixed;
  bool rotates = false;
  Isometry3d pose = Isometry3d::Identity();  // of fixed ones
  std::string place;
};

Vector3d read_vector(TextScanner& scanner, const char* x, const char* y, const char* z) {
  const double first = scanner.coordinate(x), second = scanner.coordinate(y);
  return {first, second, scanner.coordinate(z)};
}

Isometry3d read_transformation(TextScanner& scanner) {
  const Vector3d position = read_vector(scanner, "x of a pose", "y of a pose", "z of a pose");
  const Vector3d angles =
      std::numbers::pi / 180 * read_vector(scanner, "the angle about x", "the angle about y", "the angle about z");
  return Translation3d(position) * AngleAxisd(angles.z(), Vector3d::UnitZ()) *
         AngleAxisd(angles.y(), Vector3d::UnitY()) * AngleAxisd(angles.x(), Vector3d::UnitX());
}

Isometry3d read_link(TextScanner& scanner) {
  const double alpha = scanner.coordinate("alpha of a link"), a = scanner.coordinate("a of a link");
  const double d = scanner.coordinate("d of a link"), theta = scanner.coordinate("theta of a link");
  return AngleAxisd(theta, Vector3d::UnitZ()) * Translation3d(a, 0, d) * AngleAxisd(alpha, Vector3d::UnitX());
}

// "-c(1 0 0 1)", also with a blank after the c, from its first token on. What follows the bracket at once is left.
std::string read_option(TextScanner& scanner, std::string_view token) {
  std::string text(token);
  std::size_t end = text.find(')');
  while (end == std::string::npos) {
    const std::string_view next = scanner.token_in_line();
    if (next.empty()) scanner.fail(fmt::format("the option {} has no ')'", shown(token)), "close it");
    end = next.find(')') == std::string_view::npos ? std::string::npos : text.size() + next.find(')');
    text += next;
  }
  scanner.seek(scanner.position() - (text.size() - end - 1));
  return text.substr(0, end + 1);
}

bool is_option(std::string_view token) {
  return token.size() > 1 && token[0] == '-' && (token[1] == 'a' || token[1] == 'c' || token[1] == 't');
}

// The axes along which the mean of the vertices goes to the origin.
Vector3d centred_axes(const TextScanner& scanner, const std::string& option) {
  const std::string_view word = std::string_view(option).substr(std::min<std::size_t>(3, option.size() - 1));
  if (equals_ignoring_case(word, "com)")) return {1, 1, 1};
  if (equals_ignoring_case(word, "surface)")) return {1, 0, 1};
  if (equals_ignoring_case(word, "none)")) return {0, 0, 0};
  scanner.fail(fmt::format("{} centres a body by none of COM, SURFACE, NONE", shown(option)), "take one of them");
}

BodyKind to_kind(const TextScanner& scanner, std::string_view word) {
  for (const auto& [name, kind] : {std::pair{"planar", BodyKind::planar},
                                   {"volumetric", BodyKind::volumetric},
                                   {"fixed", BodyKind::fixed},
                                   {"joint", BodyKind::joint}}) {
    if (equals_ignoring_case(word, name)) return kind;
  }
  scanner.fail(fmt::format("{} is not a kind of body", shown(word)), "use Planar, Volumetric, Fixed or Joint");
}

bool read_rotates(TextScanner& scanner) {
  const std::string_view word = scanner.token();
  if (equals_ignoring_case(word, "rotational")) return true;
  if (equals_ignoring_case(word, "translational")) return false;
  scanner.fail(fmt::format("{} is not a way to move", shown(word)), "use Rotational or Translational");
}

Body read_body(TextScanner& scanner, const std::filesystem::path& folder) {
  Body body;
  const std::string name(scanner.token());
  body.place = scanner.place();
  if (name.empty()) scanner.fail("the file ends where a mesh should be named", "it was cut short: copy it again");
  Vector3d centred(1, 1, 1);
  std::size_t before = scanner.position();
  std::string_view token = scanner.token();
  while (is_option(token)) {
    const std::string option = read_option(scanner, token);
    if (option[1] == 'a') centred = centred_axes(scanner, option);
    before = scanner.position();
    token = scanner.token();
  }
  if (!token.empty() && std::isalpha(static_cast<unsigned char>(token[0])) != 0) {
    body.kind = to_kind(scanner, token);
  } else {
    scanner.seek(before);
  }
  if (body.kind == BodyKind::fixed) body.pose = read_transformation(scanner);
  if (body.kind == BodyKind::planar || body.kind == BodyKind::volumetric) body.rotates = read_rotates(scanner);

  body.mesh = read_named_mesh(folder, name, body.place);
  const Point mean = body.mesh.vertices.colwise().mean();
  body.mesh.vertices.rowwise() -= mean.cwiseProduct(centred.transpose());
  return body;
}

void expect_word(TextScanner& scanner, std::string_view word, std::string_view lower) {
  if (equals_ignoring_case(word, lower)) return;
  if (word.empty())
    scanner.fail(fmt::format("the file ends where '{}' should be", lower), "it was cut short: copy it again");
  scanner.fail(fmt::format("{} stands where '{}' should be", shown(word), lower), "correct the line");
}

std::size_t read_body_number(TextScanner& scanner, std::size_t bodies) {
  const std::int64_t number = scanner.integer("the number of a body");
  if (number < 0 || static_cast<std::size_t>(number) >= bodies) {
    scanner.fail(fmt::format("a connection names body {}, the robot has {} (from 0)", number, bodies), "correct it");
  }
  return static_cast<std::size_t>(number);
}

struct Connection {
  std::size_t parent = 0;
  Isometry3d pose;  // of the child in its parent
};

// Of each body the connection to its parent.
std::vector<std::optional<Connection>> read_connections(TextScanner& scanner, std::size_t bodies) {
  std::string_view word = scanner.token();
  if (equals_ignoring_case(word, "adjacencies"))
    scanner.fail("closed chains (Adjacencies) are not supported", "give a rigid robot");
  expect_word(scanner, word, "connections");
  const std::int64_t count = scanner.integer("the number of connections");
  std::vector<std::optional<Connection>> connections(bodies);
  for (std::int64_t i = 0; i < count; ++i) {
    const std::size_t parent = read_body_number(scanner, bodies), child = read_body_number(scanner, bodies);
    word = scanner.token();
    if (!equals_ignoring_case(word, "nonactuated")) {
      scanner.fail(fmt::format("joints that move ({}) are not supported", shown(word)),
                   "give a rigid robot, with NonActuated joints only");
    }
    if (connections[child]) scanner.fail(fmt::format("body {} has two parents", child), "give a tree of bodies");
    Isometry3d pose = read_transformation(scanner);
    pose = pose * read_link(scanner);
    pose = pose * read_transformation(scanner);
    connections[child] = Connection{parent, pose};
  }
  return connections;
}

}  // namespace

Mesh read_parasol_obstacle(TextScanner& scanner, const std::filesystem::path& folder) {
  Body body = read_body(scanner, folder);
  if (body.kind != BodyKind::fixed) throw InputError(body.place, "an obstacle is not fixed", "give its pose instead");
  move_mesh(body.mesh, body.pose);
  return std::move(body.mesh);
}

ParasolRobot read_parasol_robot(TextScanner& scanner, const std::filesystem::path& folder) {
  const std::int64_t count = scanner.integer("the number of bodies");
  if (count < 1) scanner.fail(fmt::format("a robot of {} bodies is none", count), "give at least one");
  std::vector<Body> bodies;
  std::size_t base = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    bodies.push_back(read_body(scanner, folder));
    if (bodies.back().kind == BodyKind::joint) continue;
    if (bodies[base].kind != BodyKind::joint && bodies.size() > base + 1) {
      throw InputError(bodies.back().place, "is a second base, and several robots are not supported",
                       "leave one, whose other bodies are of kind Joint");
    }
    base = bodies.size() - 1;
  }
  const std::vector<std::optional<Connection>> connections = read_connections(scanner, bodies.size());
  if (bodies[base].kind == BodyKind::joint) throw InputError(bodies[0].place, "the robot has no base", "give it one");
  if (bodies[base].kind == BodyKind::fixed) {
    throw InputError(bodies[base].place, "the robot's base is fixed and none of its joints moves",
                     "make the base Planar or Volumetric");
  }

  ParasolRobot robot;
  const bool planar = bodies[base].kind == BodyKind::planar;
  robot.kind = bodies[base].rotates ? (planar ? SpaceKind::se2 : SpaceKind::se3)
                                    : (planar ? SpaceKind::plane : SpaceKind::space);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Isometry3d pose = Isometry3d::Identity();
    std::size_t at = i, steps = 0;
    for (; at != base && connections[at] && steps < bodies.size(); ++steps) {
      pose = connections[at]->pose * pose;
      at = connections[at]->parent;
    }
    if (at != base) {
      throw InputError(bodies[i].place, fmt::format("no connections lead from the base to body {}", i), "connect it");
    }
    move_mesh(bodies[i].mesh, pose);
    robot.bodies.push_back(std::move(bodies[i].mesh));
  }
  return robot;
}

}  // namespace partwise
