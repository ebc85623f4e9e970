#include "surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "partwise/appearance/colouring.h"
#include "partwise/base/error.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/medial_samples.h"
#include "partwise/parts/surface/segmentation.h"
#include "partwise/parts/surface/shape_diameter.h"
#include "pictures.h"

namespace demo {
namespace {

using partwise::Mesh;
using partwise::Point;
using partwise::SurfaceFeature;
using partwise::VisibilityKind;

struct Feature {
  SurfaceFeature feature;
  std::optional<VisibilityKind> kind;  // none: the shape diameter
  std::string_view name;
};

constexpr std::array<Feature, 4> features{{
    {SurfaceFeature::shape_diameter, std::nullopt, "SDF"},
    {SurfaceFeature::visibility, VisibilityKind::cvf, "CVF"},
    {SurfaceFeature::visibility_average, VisibilityKind::avg, "CVF averaged"},
    {SurfaceFeature::visibility_weak, VisibilityKind::weak, "CVF weak"},
}};

constexpr partwise::PreviewSettings small{.width = 396, .height = 330};

partwise::Image draw_mesh(partwise::PreviewMesh mesh, double azimuth) {
  partwise::PreviewScene scene;
  scene.meshes.push_back(std::move(mesh));
  return draw(scene, azimuth, small);
}

FeatureStory tell_feature(const Feature& feature, const ShownModel& shown) {
  const Mesh& mesh = *shown.mesh;
  FeatureStory story;
  story.name = feature.name;
  Eigen::VectorXd values;  // a face
  if (feature.kind) {
    const partwise::VisibilityFeature seen = continuous_visibility(mesh, {.kind = *feature.kind});
    values = face_means(mesh, seen.values);
    story.tests = seen.tests;
  } else {
    values = shape_diameter(mesh).values;
  }
  const partwise::Segmentation cut = segment(mesh, {.feature = feature.feature});
  story.part_count = cut.parts;
  for (const auto& [stage, seconds] : cut.seconds) story.seconds += seconds;
  const double azimuth = shown.model->azimuth;
  story.map = make_picture(draw_mesh(coloured_by_value(mesh, values), azimuth), story.name,
                           fmt::format("{}: {} from dark blue to yellow", shown.model->name, feature.name));
  story.parts =
      make_picture(draw_mesh(coloured_by_part(mesh, cut.labels), azimuth),
                   fmt::format("{}: {} part{}", feature.name, cut.parts, cut.parts == 1 ? "" : "s"),
                   fmt::format("{}: faces in the colours of their parts by {}", shown.model->name, feature.name));
  return story;
}

// What lies behind the plane through `on`, whose normal points to what is cut away.
Mesh far_half(const Mesh& mesh, const Point& on, const Point& normal) {
  std::vector<Point> corners;
  const auto height = [&](const Point& p) { return (p - on).dot(normal); };
  for (const auto& face : mesh.faces.rowwise()) {
    std::vector<Point> kept;  // the corners of the rest of the face, three or four
    for (int k = 0; k < 3; ++k) {
      const Point a = mesh.vertices.row(face[k]), b = mesh.vertices.row(face[(k + 1) % 3]);
      if (height(a) <= 0) kept.push_back(a);
      if ((height(a) <= 0) != (height(b) <= 0)) kept.push_back(a + (b - a) * (height(a) / (height(a) - height(b))));
    }
    for (std::size_t i = 2; i < kept.size(); ++i) corners.insert(corners.end(), {kept[0], kept[i - 1], kept[i]});
  }
  Mesh half;
  const auto count = static_cast<Eigen::Index>(corners.size());
  half.vertices.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) half.vertices.row(i) = corners[static_cast<std::size_t>(i)];
  half.faces.resize(count / 3, 3);
  for (Eigen::Index i = 0; i < count; ++i) half.faces(i / 3, i % 3) = static_cast<int>(i);
  return half;
}

// Seen from its side, along x, with the nearer half cut away: the samples in what is left of the model.
Picture tell_medial(const ShownModel& shown) {
  const Mesh& mesh = *shown.mesh;
  const partwise::MedialSamples samples = medial_samples(mesh);
  const partwise::Sphere sphere = bounding_sphere(mesh);
  partwise::PreviewScene scene;
  scene.meshes.push_back({far_half(mesh, sphere.centre, Point::UnitX()), {}});
  scene.points = partwise::coloured_by_value(samples.points, samples.radii, 0.012 * sphere.radius);
  return make_picture(draw(scene, 90, small), fmt::format("{}: {} points", shown.model->name, samples.radii.size()),
                      fmt::format("{}, cut open, with points of its medial axis as beads", shown.model->name));
}

}  // namespace

SurfacesStory tell_surfaces(std::span<const ShownModel> models) {
  const auto named = [&](std::string_view name) -> const ShownModel& {
    const auto found = std::ranges::find_if(models, [&](const ShownModel& shown) { return shown.model->name == name; });
    PARTWISE_CHECK(found == models.end(), ==, false);
    return *found;
  };
  SurfacesStory story;
  for (const std::string_view name : {"Horse", "Deer", "Chair", "Coffee cup"}) {
    const ShownModel& shown = named(name);
    SurfaceStory& model = story.models.emplace_back();
    model.name = shown.model->name;
    model.vertices = static_cast<int>(shown.mesh->vertices.rows());
    for (const Feature& feature : features) model.features.push_back(tell_feature(feature, shown));
  }
  for (const std::string_view name : {"Horse", "Deer", "Teddy bear", "Garden tap"})
    story.medial.push_back(tell_medial(named(name)));
  return story;
}

}  // namespace demo
