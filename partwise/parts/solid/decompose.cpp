#include "partwise/parts/solid/decompose.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/principal_axes.h"
#include "partwise/geometry/subdivide.h"
#include "partwise/geometry/topology.h"
#include "partwise/geometry/union_volume.h"
#include "partwise/parts/solid/convex_ridges.h"
#include "partwise/parts/solid/convex_solid.h"
#include "partwise/parts/solid/hull_decomposition.h"
#include "partwise/parts/solid/part_merging.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace partwise {
namespace {

constexpr double kSmallestTolerance = 1e-3;   // of R: the octree of distances would not end
constexpr double kLargestThickness = 1e-3;    // of R: what flat hulls are given, or a tenth of the tolerance if less
constexpr double kSmallestCube = 1.0 / 32;    // of the tolerance: side of the smallest cubes of the octree
constexpr double kCertainty = 1 - 1e-4;       // of the tolerance: room for distances in single precision
constexpr double kMeasureAccuracy = 1.0 / 8;  // of the tolerance: of the concavity that is reported
constexpr double kLargestAir = 10;            // see largest_air(); of the measure valley
constexpr int kSamples = 6000;                // of the space in the convex hull
constexpr double kCoarseEdge = 0.5;           // of the tolerance: longest edge of a mesh whose faces are cut inside
constexpr int kCoarseFaces = 5000;            // meshes with more faces are not cut inside
constexpr int kMostFacesCut = 200000;

class Stopwatch {
 public:
  explicit Stopwatch(std::map<std::string, double>& seconds) : seconds_(seconds) {}
  template <typename Work>
  auto time(const char* stage, const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    auto result = work();
    seconds_[stage] += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

 private:
  std::map<std::string, double>& seconds_;
};

void check(const Mesh& mesh, const DecompositionSettings& settings, double radius) {
  for (int v : mesh.faces.reshaped())
    if (!mesh.vertices.row(v).allFinite())
      throw InputError("mesh", fmt::format("vertex {} is not finite", v), "give coordinates that are numbers");
  if (!(radius > 0))
    throw InputError("mesh", "no face of positive area", "give a mesh with at least one proper triangle");
  if (!(settings.tolerance > 0) || !std::isfinite(settings.tolerance))
    throw InputError("tolerance", "is not a positive number", "give one, 0.1 for coarse and 0.02 for fine parts");
  const double relative = settings.absolute ? settings.tolerance / radius : settings.tolerance;
  if (relative < kSmallestTolerance)
    throw InputError("tolerance", fmt::format("{:g} of the bounding-sphere radius is too fine", relative),
                     fmt::format("give at least {:g}", kSmallestTolerance));
  if (settings.cup_repair && settings.measure != ConcavityMeasure::valley)
    throw InputError("cup_repair", "is of the measure valley", "leave it out, hull cuts cups anyway");
  if (settings.max_hulls < 0) throw InputError("max_hulls", "is negative", "give 0 for no limit");
  if (settings.max_hull_vertices < 0 || (settings.max_hull_vertices > 0 && settings.max_hull_vertices < 4))
    throw InputError("max_hull_vertices", "is below 4", "give 0 for no limit, or 4 and more");
}

// Rounded to multiples of 2^-38, so that the rounding that came with placing the mesh decides no ties: the grid is so
// coarse that few coordinates are rounded to another multiple, and far below what vertices may be out of a hull.
Vertices on_grid(const Vertices& vertices) {
  constexpr double kPerUnit = 0x1p38;
  return (vertices * kPerUnit).array().round() / kPerUnit;
}

// The mesh centred, scaled to a bounding sphere of radius 1 and turned to its principal axes, so that the parts do not
// depend on how it was placed; faces turned one way; and what is measured on it.
struct Scene {
  Sphere sphere;
  Eigen::Matrix3d axes;
  Mesh mesh;
  bool closed;
  SurfaceQuery surface;
  SpaceSamples space;
  OutsideDistance outside;

  Scene(const Mesh& input, const Sphere& bounds, double tolerance, double thickness)
      : sphere(bounds),
        axes(principal_axes(input)),
        mesh(orient_consistently({on_grid(placed(input.vertices)), input.faces})),
        closed(is_watertight(mesh)),
        surface(mesh),
        space(sample_space(surface, convex_hull(corners_of(mesh, all_faces()), thickness).mesh, kSamples)),
        outside(surface, closed, {Point::Zero(), 1.0}, kSmallestCube * tolerance) {}

  Vertices placed(const Vertices& vertices) const {
    return (vertices.rowwise() - sphere.centre) * axes.transpose() / sphere.radius;
  }

  std::vector<int> all_faces() const {
    std::vector<int> faces(static_cast<std::size_t>(mesh.faces.rows()));
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
  }
};

CupRepair cup_repair(const Scene& scene, const DecompositionSettings& settings) {
  return {.on = settings.cup_repair, .two_sided = !scene.closed};
}

std::vector<HullPart> valley_parts(const Scene& scene, double tolerance, const DecompositionSettings& settings,
                                   const Progress& progress) {
  const double thickness = kBridgeThickness * tolerance;
  const CupRepair repair = cup_repair(scene, settings);
  std::vector<HullPart> parts;
  for (auto& group : connected_groups(scene.mesh, scene.all_faces())) {
    for (auto& faces : valley_decomposition(scene.mesh, scene.surface, std::move(group), tolerance, repair, progress))
      parts.push_back(hull_part(scene.mesh, std::move(faces), thickness));
  }
  const AcceptMerge accept = [&](const HullPart& merged) {
    const PartGraph part = part_graph(scene.mesh, merged.faces);
    return !has_deep_valley(part, part_hull(part, merged.hull, merged.source), scene.surface, tolerance, repair,
                            kRimDepthMerging);
  };
  PartMerging merging(scene.mesh, scene.space, std::move(parts), accept,
                      {thickness, largest_air(scene.space, tolerance, kLargestAir)});
  do merging.merge(progress);
  while (merging.dissolve(progress) > 0);
  parts = merging.parts();
  if (settings.max_hulls > 0) merge_down_to(settings.max_hulls, scene.mesh, scene.space, parts, thickness, progress);
  return parts;
}

// The hull of a part as delivered, of the scaled mesh, which the promise was tested on, and in model units: there it is
// made anew from the vertices of the input, unless it was simplified.
struct DeliveredHull {
  Mesh scaled, hull;
};

DeliveredHull delivered_hull(const Mesh& input, const Scene& scene, const HullPart& part, const HullPromise& promise,
                             double thickness) {
  DeliveredHull delivered{promise.shape(part.hull), {}};
  const auto in_model_units = [&](const Mesh& scaled) -> Mesh {
    return {(scaled.vertices * scene.axes * scene.sphere.radius).rowwise() + scene.sphere.centre, scaled.faces};
  };
  if (delivered.scaled.vertices.rows() < part.hull.vertices.rows()) {
    delivered.hull = in_model_units(delivered.scaled);
    return delivered;
  }
  Corners corners = exact_corners(scene.mesh, part);
  for (std::size_t i = 0; i < corners.source.size(); ++i)
    if (corners.source[i] >= 0)
      corners.points.row(static_cast<Eigen::Index>(i)) = scene.placed(input.vertices.row(corners.source[i]));
  const ConvexHull hull = convex_hull(corners.points, thickness);
  delivered.hull = in_model_units(hull.mesh);
  for (Eigen::Index v = 0; v < hull.mesh.vertices.rows() && !hull.thickened; ++v) {
    const int source = corners.source[static_cast<std::size_t>(hull.source[static_cast<std::size_t>(v)])];
    if (source >= 0) delivered.hull.vertices.row(v) = input.vertices.row(source);
  }
  return delivered;
}

struct Result {
  std::vector<HullPart> parts;
  std::vector<DeliveredHull> hulls;
  double concavity = 0;  // of the scaled mesh
};

double deepest_valley(const Scene& scene, const std::vector<HullPart>& parts, double tolerance, const CupRepair& repair,
                      const Progress& progress) {
  double concavity = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    progress("measuring", static_cast<double>(p) / static_cast<double>(parts.size()));
    const PartGraph part = part_graph(scene.mesh, parts[p].faces);
    const PartHull hull = part_hull(part, parts[p].hull, parts[p].source);  // the one that merging was asked about
    concavity =
        std::max(concavity, find_bridges(part, hull, scene.surface, tolerance, repair, kRimDepthMerging).concavity);
  }
  return concavity;
}

// Roughly: where a hull lies on the surface, every cube along it would be looked at down to the smallest.
double farthest_reach(Scene& scene, const std::vector<DeliveredHull>& hulls, double tolerance,
                      const Progress& progress) {
  double concavity = 0;
  for (std::size_t p = 0; p < hulls.size(); ++p) {
    progress("measuring", static_cast<double>(p) / static_cast<double>(hulls.size()));
    const ConvexBody body(hulls[p].scaled);
    double reach = scene.outside.reach(body, kMeasureAccuracy * tolerance).distance;
    if (reach > tolerance && scene.outside.within(body, tolerance)) reach = tolerance;
    concavity = std::max(concavity, reach);
  }
  return concavity;
}

Result run(const Mesh& input, Scene& scene, double tolerance, const DecompositionSettings& settings, Stopwatch& watch,
           const Progress& progress) {
  const double thickness = std::min(kLargestThickness, tolerance / 10);
  const HullPromise promise(scene.outside, kCertainty * tolerance, settings.max_hull_vertices);
  Result result;
  result.parts = watch.time("parts", [&] {
    if (settings.measure == ConcavityMeasure::valley) return valley_parts(scene, tolerance, settings, progress);
    return hull_decomposition(scene.mesh, scene.surface, scene.space, scene.outside, promise,
                              {.minimum_thickness = thickness, .max_hulls = settings.max_hulls}, progress);
  });
  std::sort(result.parts.begin(), result.parts.end(),
            [](const HullPart& a, const HullPart& b) { return a.faces.front() < b.faces.front(); });
  if (settings.measure == ConcavityMeasure::valley) {
    result.concavity = watch.time("measure", [&] {
      return deepest_valley(scene, result.parts, tolerance, cup_repair(scene, settings), progress);
    });
    for (HullPart& part : result.parts) set_hull(part, exact_corners(scene.mesh, part), thickness);
  }
  result.hulls = watch.time("hulls", [&] {
    std::vector<DeliveredHull> hulls;
    for (const HullPart& part : result.parts) hulls.push_back(delivered_hull(input, scene, part, promise, thickness));
    return hulls;
  });
  if (settings.measure == ConcavityMeasure::hull)
    result.concavity = watch.time("measure", [&] { return farthest_reach(scene, result.hulls, tolerance, progress); });
  return result;
}

std::vector<int> labels_of(const std::vector<HullPart>& parts, Eigen::Index faces) {
  std::vector<int> labels(static_cast<std::size_t>(faces), 0);
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (int f : parts[p].faces) labels[f] = static_cast<int>(p);
  return labels;
}

// The label with the largest area among the faces that each input face was cut into.
std::vector<int> majority(const Subdivision& cut, const std::vector<int>& cut_labels, Eigen::Index faces) {
  std::vector<std::map<int, double>> area(static_cast<std::size_t>(faces));
  for (std::size_t f = 0; f < cut.parent.size(); ++f) {
    const auto face = cut.mesh.faces.row(static_cast<Eigen::Index>(f));
    const Point a = cut.mesh.vertices.row(face[0]);
    const Point across = (cut.mesh.vertices.row(face[1]) - a).cross(cut.mesh.vertices.row(face[2]) - a);
    area[cut.parent[f]][cut_labels[f]] += across.norm();
  }
  std::vector<int> labels;
  labels.reserve(area.size());
  for (const auto& shares : area)
    labels.push_back(std::max_element(shares.begin(), shares.end(), [](const auto& x, const auto& y) {
                       return x.second < y.second;
                     })->first);
  return labels;
}

// Whether one label a face ended in crumbs: a part of at most two faces, on a mesh with few and long faces.
bool too_coarse(const Mesh& mesh, const std::vector<HullPart>& parts) {
  return mesh.faces.rows() <= kCoarseFaces && parts.size() > 1 &&
         std::any_of(parts.begin(), parts.end(), [](const HullPart& p) { return p.faces.size() <= 2; });
}

// Cut to edges of this length, or to twice, four times ... that where it would make too many faces.
Subdivision cut_for(const Mesh& mesh, double longest) {
  for (;; longest *= 2) {
    try {
      return split_long_edges(mesh, longest, kMostFacesCut);
    } catch (const InputError&) {  // Ends: a mesh this coarse has few enough faces when none is cut.
    }
  }
}

}  // namespace

Decomposition decompose(const Mesh& mesh, const DecompositionSettings& settings, const Progress& progress) {
  const Sphere sphere = bounding_sphere(mesh);
  check(mesh, settings, sphere.radius);
  Decomposition result;
  Stopwatch watch(result.seconds);
  result.radius = sphere.radius;
  result.tolerance = settings.tolerance;
  const double tolerance = settings.absolute ? settings.tolerance / sphere.radius : settings.tolerance;
  const double thickness = std::min(kLargestThickness, tolerance / 10);

  if (std::optional<Mesh> hull = convex_solid(mesh, sphere, thickness);
      hull && (settings.max_hull_vertices == 0 || hull->vertices.rows() <= settings.max_hull_vertices)) {
    result.mesh = mesh;
    result.labels.assign(static_cast<std::size_t>(mesh.faces.rows()), 0);
    result.mesh_labels = result.labels;
    result.hulls.push_back(*std::move(hull));
    result.watertight = true;
    result.volume_ratio = 1;
    return result;
  }
  auto scene = watch.time("prepare", [&] { return std::make_unique<Scene>(mesh, sphere, tolerance, thickness); });
  Result best = run(mesh, *scene, tolerance, settings, watch, progress);
  result.mesh = mesh;
  result.labels = result.mesh_labels = labels_of(best.parts, mesh.faces.rows());
  if (settings.measure == ConcavityMeasure::hull && too_coarse(mesh, best.parts)) {
    const Subdivision cut = cut_for(mesh, kCoarseEdge * tolerance * sphere.radius);
    scene = watch.time("prepare", [&] { return std::make_unique<Scene>(cut.mesh, sphere, tolerance, thickness); });
    Result finer = run(cut.mesh, *scene, tolerance, settings, watch, progress);
    if (finer.parts.size() < best.parts.size()) {
      best = std::move(finer);
      result.cut_inside = true;
      result.mesh = cut.mesh;
      result.mesh_labels = labels_of(best.parts, cut.mesh.faces.rows());
      result.labels = majority(cut, result.mesh_labels, mesh.faces.rows());
    }
  }
  for (const DeliveredHull& hull : best.hulls) result.hulls.push_back(hull.hull);
  result.concavity = best.concavity * (settings.absolute ? sphere.radius : 1);
  result.watertight = scene->closed;
  result.volume_ratio = watch.time("volume", [&] {
    if (!result.watertight) return std::numeric_limits<double>::quiet_NaN();
    std::vector<Mesh> scaled;
    for (const DeliveredHull& hull : best.hulls) scaled.push_back(hull.scaled);
    return union_volume(scaled) / coverage(scene->mesh, {}).solid_volume;
  });
  return result;
}

}  // namespace partwise
