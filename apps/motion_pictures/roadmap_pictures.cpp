#include "motion_pictures/roadmap_pictures.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "partwise/appearance/palette.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise {
namespace {

constexpr int levels = 12;  // of clearance, each with a colour

// Edges by the smaller clearance of their ends, in equal shares.
class Levels {
 public:
  Levels(const std::vector<AxisSample>& samples, const Roadmap& roadmap) {
    for (const RoadmapEdge& each : roadmap.edges) {
      clearances_.push_back(std::min(samples[static_cast<std::size_t>(each.from)].state.clearance(),
                                     samples[static_cast<std::size_t>(each.to)].state.clearance()));
    }
    std::vector<double> sorted = clearances_;
    std::ranges::sort(sorted);
    for (std::size_t i = 1; i < levels && !sorted.empty(); ++i) limits_.push_back(sorted[i * sorted.size() / levels]);
  }

  int of(std::size_t edge) const {
    return static_cast<int>(std::ranges::upper_bound(limits_, clearances_[edge]) - limits_.begin());
  }
  static Eigen::Vector3f colour(int level) { return value_colour(static_cast<float>(level) / (levels - 1)); }

 private:
  std::vector<double> clearances_, limits_;
};

std::string hex(const Eigen::Vector3f& linear) {
  std::string text = "#";
  for (const float each : linear)
    text += fmt::format("{:02x}", static_cast<int>(std::lround(255 * std::pow(std::clamp(each, 0.f, 1.f), 1 / 2.2f))));
  return text;
}

std::vector<Configuration> polyline(const RoadmapEdge& edge, const std::vector<AxisSample>& samples) {
  std::vector<Configuration> points = {samples[static_cast<std::size_t>(edge.from)].q};
  points.insert(points.end(), edge.between.begin(), edge.between.end());
  points.push_back(samples[static_cast<std::size_t>(edge.to)].q);
  return points;
}

// A prism of three sides around a segment.
void add_tube(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius, std::vector<Point>& vertices) {
  const Eigen::Vector3d along = (b - a).normalized();
  const Eigen::Vector3d side = along.unitOrthogonal(), up = along.cross(side);
  for (const Eigen::Vector3d& end : {a, b}) {
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * EIGEN_PI * k / 3;
      vertices.emplace_back((end + radius * (std::cos(angle) * side + std::sin(angle) * up)).transpose());
    }
  }
}

Mesh tubes(const std::vector<Point>& vertices) {
  static constexpr std::array<std::array<int, 3>, 6> sides = {
      {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}, {2, 0, 5}, {0, 3, 5}}};
  Mesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  for (std::size_t i = 0; i < vertices.size(); ++i) mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices[i];
  mesh.faces.resize(mesh.vertices.rows(), 3);
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
    for (int k = 0; k < 3; ++k)
      mesh.faces(i, k) =
          static_cast<int>(i / 6 * 6) + sides[static_cast<std::size_t>(i % 6)][static_cast<std::size_t>(k)];
  }
  return mesh;
}

}  // namespace

std::string roadmap_svg(const std::vector<Polygons>& obstacles, const std::vector<AxisSample>& samples,
                        const Roadmap& roadmap, const std::vector<MotionPath>& ways) {
  Eigen::AlignedBox2d box;
  for (const Polygons& each : obstacles) box.extend(bounding_box(each));
  for (const AxisSample& each : samples) box.extend(Eigen::Vector2d(each.q.head<2>()));
  constexpr double size = 1600, margin = 20;
  const double scale = (size - 2 * margin) / std::max(box.sizes().maxCoeff(), 1e-300);
  const auto point = [&](double x, double y) {
    return fmt::format("{:.1f} {:.1f}", margin + scale * (x - box.min().x()), margin + scale * (box.max().y() - y));
  };
  const Eigen::Vector2d sheet = scale * box.sizes() + Eigen::Vector2d::Constant(2 * margin);
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<path fill=\"#c9c9c4\" fill-rule=\"evenodd\" d=\"",
      sheet.x(), sheet.y());
  const auto add_ring = [&](const Ring& ring) {
    for (Eigen::Index i = 0; i < ring.rows(); ++i) {
      text += i == 0 ? 'M' : 'L';
      text += point(ring(i, 0), ring(i, 1));
    }
    text += 'Z';
  };
  for (const Polygons& polygons : obstacles) {
    for (const Polygon& polygon : polygons) {
      add_ring(polygon.outer);
      for (const Ring& hole : polygon.holes) add_ring(hole);
    }
  }
  text += "\"/>\n";
  const Levels by(samples, roadmap);
  std::vector<std::string> paths(levels);
  const auto add_line = [&](const std::vector<Configuration>& line, std::string& to) {
    char verb = 'M';
    for (const Configuration& q : line) {
      to += verb;
      to += point(q[0], q[1]);
      verb = 'L';
    }
  };
  for (std::size_t e = 0; e < roadmap.edges.size(); ++e)
    add_line(polyline(roadmap.edges[e], samples), paths[static_cast<std::size_t>(by.of(e))]);
  for (int level = 0; level < levels; ++level) {
    text += fmt::format("<path fill=\"none\" stroke-width=\"1.2\" stroke=\"{}\" d=\"{}\"/>\n",
                        hex(Levels::colour(level)), paths[static_cast<std::size_t>(level)]);
  }
  constexpr std::array<const char*, 2> way_colours{"#c8102e", "#ff8200"};
  for (std::size_t i = 0; i < ways.size(); ++i) {
    std::string line;
    add_line(ways[i].configurations, line);
    text += fmt::format("<path fill=\"none\" stroke-width=\"4\" stroke-linejoin=\"round\" stroke=\"{}\" d=\"{}\"/>\n",
                        way_colours[i % way_colours.size()], line);
  }
  return text + "</svg>\n";
}

Mesh tube_along(const std::vector<Eigen::Vector3d>& line, double radius) {
  std::vector<Point> vertices;
  for (std::size_t i = 1; i < line.size(); ++i) add_tube(line[i - 1], line[i], radius, vertices);
  return tubes(vertices);
}

void write_roadmap_glb(const std::filesystem::path& path, const std::vector<Mesh>& obstacles,
                       const std::vector<AxisSample>& samples, const Roadmap& roadmap) {
  Eigen::AlignedBox3d box;
  for (const Mesh& mesh : obstacles) {
    for (const auto& vertex : mesh.vertices.rowwise()) box.extend(vertex.transpose());
  }
  const double radius = 0.00075 * box.diagonal().norm();
  const Levels by(samples, roadmap);
  std::vector<std::vector<Point>> vertices(levels);
  for (std::size_t e = 0; e < roadmap.edges.size(); ++e) {
    const std::vector<Configuration> points = polyline(roadmap.edges[e], samples);
    for (std::size_t i = 1; i < points.size(); ++i) {
      add_tube(points[i - 1].head<3>(), points[i].head<3>(), radius, vertices[static_cast<std::size_t>(by.of(e))]);
    }
  }
  std::vector<NamedMesh> meshes;
  for (const Mesh& mesh : obstacles) meshes.push_back({"obstacle", mesh});
  for (int level = 0; level < levels; ++level) {
    const auto& tube = vertices[static_cast<std::size_t>(level)];
    if (!tube.empty()) meshes.push_back({fmt::format("axis {}", level), tubes(tube), Levels::colour(level)});
  }
  write_meshes(path, meshes);
}

}  // namespace partwise
