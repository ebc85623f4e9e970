#include "partwise/parts/surface/medial_samples.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "partwise/base/error.h"
#include "partwise/geometry/inner_visibility.h"
#include "partwise/geometry/subdivide.h"
#include "partwise/geometry/surface_query.h"
#include "partwise/parts/surface/surface_graph.h"
#include "partwise/parts/surface/visible_regions.h"

namespace partwise {
namespace {

constexpr double kFinestSpacing = 0.005;
constexpr int kMostFaces = 2'000'000;

void check(const MedialSettings& settings) {
  if (!(settings.spacing >= kFinestSpacing) || !std::isfinite(settings.spacing))
    throw InputError("spacing", fmt::format("is {:g}", settings.spacing),
                     fmt::format("give a share of R of at least {:g}", kFinestSpacing));
  if (!(settings.least_angle >= 0 && settings.least_angle <= std::numbers::pi))
    throw InputError("least_angle", fmt::format("is {:g}", settings.least_angle), "give radians in [0, pi]");
  if (!(settings.most_overlap > 0 && settings.most_overlap <= 1))
    throw InputError("most_overlap", fmt::format("is {:g}", settings.most_overlap), "give more than 0, at most 1");
}

struct Ball {
  double radius = std::numeric_limits<double>::infinity();
  int other = -1;  // the vertex where it touches again
};

// The largest ball that touches at p, has its centre along `inwards`, and inside none of the region's vertices that are
// higher above p's tangent plane than `least_sine` of their distance.
Ball touching_ball(const Vertices& vertices, int p, const Point& inwards, const std::vector<int>& region,
                   double least_sine) {
  Ball ball;
  const Point at = vertices.row(p);
  for (const int q : region) {
    const Point across = vertices.row(q) - at;
    const double depth = inwards.dot(across), square = across.squaredNorm();
    if (depth <= 0 || depth * depth < least_sine * least_sine * square) continue;
    const double radius = square / (2 * depth);
    if (radius < ball.radius || (radius == ball.radius && q < ball.other)) ball = {radius, q};
  }
  return ball;
}

}  // namespace

MedialSamples medial_samples(const Mesh& mesh, const MedialSettings& settings, const Progress& progress) {
  check(settings);
  const Sphere bounds = bounding_sphere(mesh);
  const Mesh fine = split_long_edges(mesh, settings.spacing * bounds.radius, kMostFaces).mesh;
  const SurfaceGraph graph = surface_graph(fine);
  const Vertices& vertices = graph.mesh.vertices;
  const Vertices normals = vertex_normals(graph.mesh);
  const SurfaceQuery surface(graph.mesh);
  const InnerVisibility visibility(graph.mesh);

  // Seen from the centre, p and q are twice as far apart as q is high above p's tangent plane.
  const double least_sine = std::sin(settings.least_angle / 2);
  std::vector<std::optional<Ball>> balls(static_cast<std::size_t>(graph.size()));
  for_each_region(graph, visibility, VisibilityMethod::filter, progress, [&](int p, const std::vector<int>& region) {
    const Point inwards = -normals.row(p);
    const Ball ball = touching_ball(vertices, p, inwards, region, least_sine);
    if (ball.other < 0) return;
    const Point centre = vertices.row(p) + ball.radius * inwards;
    if (surface.distance(centre, ball.radius) < (1 - settings.most_overlap) * ball.radius) return;
    balls[static_cast<std::size_t>(p)] = ball;
  });

  MedialSamples samples;
  std::vector<Point> centres;
  std::vector<char> done(balls.size(), 0);
  for (Eigen::Index v = 0; v < fine.vertices.rows(); ++v) {
    const int p = graph.of_input[static_cast<std::size_t>(v)];
    if (p < 0 || !balls[static_cast<std::size_t>(p)] || done[static_cast<std::size_t>(p)]) continue;
    done[static_cast<std::size_t>(p)] = 1;
    const double radius = balls[static_cast<std::size_t>(p)]->radius * graph.radius;
    centres.push_back(fine.vertices.row(v) - radius * normals.row(p));
    samples.radii.push_back(radius);
  }
  samples.points.resize(static_cast<Eigen::Index>(centres.size()), 3);
  for (std::size_t i = 0; i < centres.size(); ++i) samples.points.row(static_cast<Eigen::Index>(i)) = centres[i];
  return samples;
}

}  // namespace partwise
