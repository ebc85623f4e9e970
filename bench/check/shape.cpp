#include "bench/check/shape.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace partwise::bench {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int line, const std::string& what) {
  throw std::runtime_error(path.string() + ":" + std::to_string(line) + ": " + what);
}

std::ifstream open(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be opened");
  return in;
}

// The next line that says something, without its comment; empty at the end of the file.
std::string next_line(std::istream& in, int& line) {
  for (std::string text; std::getline(in, text);) {
    ++line;
    text = text.substr(0, text.find('#'));
    if (text.find_first_not_of(" \t\r") != std::string::npos) return text;
  }
  return {};
}

Point read_point(std::istringstream& in, const std::filesystem::path& path, int line) {
  double x, y, z;
  if (!(in >> x >> y >> z) || !std::isfinite(x + y + z)) fail(path, line, "expected three coordinates");
  return {x, y, z};
}

Shape read_off(const std::filesystem::path& path) {
  std::ifstream in = open(path);
  int line = 0;
  std::string header = next_line(in, line);
  if (header.rfind("OFF", 0) != 0) fail(path, line, "expected OFF");
  header = header.substr(3);
  if (header.find_first_not_of(" \t\r") == std::string::npos) header = next_line(in, line);
  long vertices = 0, faces = 0;
  if (!(std::istringstream(header) >> vertices >> faces))
    fail(path, line, "expected the numbers of vertices and faces");
  Shape shape;
  for (long i = 0; i < vertices; ++i) {
    std::istringstream text(next_line(in, line));
    shape.vertices.push_back(read_point(text, path, line));
  }
  for (long i = 0; i < faces; ++i) {
    std::istringstream text(next_line(in, line));
    int corners = 0;
    std::array<int, 3> face{};
    if (!(text >> corners) || corners != 3) fail(path, line, "expected a triangle");
    for (int& corner : face)
      if (!(text >> corner) || corner < 0 || corner >= vertices) fail(path, line, "expected three vertex numbers");
    shape.faces.push_back(face);
  }
  return shape;
}

}  // namespace

double Shape::signed_volume() const {
  if (vertices.empty()) return 0;
  const Point origin = vertices.front();
  double volume = 0;
  for (const auto& [a, b, c] : faces)
    volume += CGAL::determinant(vertices[a] - origin, vertices[b] - origin, vertices[c] - origin) / 6;
  return volume;
}

bool Shape::closed() const {
  std::map<std::pair<int, int>, int> balance;
  for (const auto& face : faces)
    for (int k = 0; k < 3; ++k) {
      const int a = face[k], b = face[(k + 1) % 3];
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  for (const auto& [edge, count] : balance)
    if (count != 0) return false;
  return !faces.empty();
}

std::vector<Shape> read_objects(const std::filesystem::path& path) {
  std::ifstream in = open(path);
  std::vector<Shape> objects;
  std::vector<Point> vertices;           // OBJ numbers the vertices of the whole file
  std::vector<std::pair<int, int>> own;  // the object that last used a vertex, and the vertex's number there
  int line = 0;
  for (std::string text = next_line(in, line); !text.empty(); text = next_line(in, line)) {
    std::istringstream words(text);
    std::string key;
    words >> key;
    if (key == "o") objects.emplace_back();
    if (key == "v") {
      vertices.push_back(read_point(words, path, line));
      own.emplace_back(-1, -1);
    }
    if (key != "f") continue;
    if (objects.empty()) objects.emplace_back();
    const int object = static_cast<int>(objects.size()) - 1;
    std::vector<int> corners;
    for (std::string word; words >> word;) {
      int number = 0;
      std::from_chars(word.data(), word.data() + word.size(), number);
      const int vertex = number < 0 ? number + static_cast<int>(vertices.size()) : number - 1;
      if (number == 0 || vertex < 0 || vertex >= static_cast<int>(vertices.size())) fail(path, line, "no such vertex");
      if (own[vertex].first != object) {
        own[vertex] = {object, static_cast<int>(objects[object].vertices.size())};
        objects[object].vertices.push_back(vertices[vertex]);
      }
      corners.push_back(own[vertex].second);
    }
    if (corners.size() != 3) fail(path, line, "expected a triangle");
    objects[object].faces.push_back({corners[0], corners[1], corners[2]});
  }
  return objects;
}

Shape read_shape(const std::filesystem::path& path) {
  if (path.extension() == ".off") return read_off(path);
  if (path.extension() != ".obj") throw std::runtime_error(path.string() + ": expected .off or .obj");
  Shape all;
  for (const Shape& object : read_objects(path)) {
    const int first = static_cast<int>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), object.vertices.begin(), object.vertices.end());
    for (const auto& [a, b, c] : object.faces) all.faces.push_back({first + a, first + b, first + c});
  }
  return all;
}

std::vector<int> read_labels(const std::filesystem::path& path) {
  std::ifstream in = open(path);
  std::vector<int> labels;
  int line = 0;
  for (std::string text = next_line(in, line); !text.empty(); text = next_line(in, line)) {
    std::istringstream words(text);
    int label = 0;
    std::string rest;
    if (!(words >> label) || words >> rest) fail(path, line, "expected one whole number");
    labels.push_back(label);
  }
  return labels;
}

void write_objects(const std::filesystem::path& path, const std::vector<Shape>& objects) {
  std::ofstream out(path);
  out.precision(17);
  std::size_t first = 1;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    out << "o hull_" << i << '\n';
    for (const Point& p : objects[i].vertices) out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& [a, b, c] : objects[i].faces)
      out << "f " << first + a << ' ' << first + b << ' ' << first + c << '\n';
    first += objects[i].vertices.size();
  }
  if (!out.flush()) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace partwise::bench
