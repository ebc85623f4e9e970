// partwise.feature, segment and medial_samples: features of surfaces, what is cut by them, and points inside.
#include <pybind11/stl.h>

#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "arrays.h"
#include "bindings.h"
#include "choices.h"
#include "long_call.h"
#include "mesh_arguments.h"
#include "partwise/geometry/smoothing.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/medial_samples.h"
#include "partwise/parts/surface/segmentation.h"
#include "partwise/parts/surface/shape_diameter.h"

namespace partwise::python {
namespace {

// None: the shape diameter.
const Choices<std::optional<VisibilityKind>> kinds = {{"cvf", VisibilityKind::cvf},
                                                      {"cvf-avg", VisibilityKind::avg},
                                                      {"cvf-strong", VisibilityKind::strong},
                                                      {"cvf-weak", VisibilityKind::weak},
                                                      {"sdf", std::nullopt}};
const Choices<SurfaceFeature> features = {{"cvf", SurfaceFeature::visibility},
                                          {"cvf-avg", SurfaceFeature::visibility_average},
                                          {"cvf-strong", SurfaceFeature::visibility_strong},
                                          {"cvf-weak", SurfaceFeature::visibility_weak},
                                          {"sdf", SurfaceFeature::shape_diameter}};
const Choices<Borders> borders = {
    {"automatic", Borders::automatic}, {"plain", Borders::plain}, {"learnt", Borders::learnt}};

py::array feature(const py::object& mesh, const std::string& kind, double weak_threshold, int smooth) {
  const SharedMesh input = mesh_in(mesh);
  const std::optional<VisibilityKind> visibility = chosen("kind", kind, kinds);
  if (smooth < 0) throw InputError("smooth", "is below 0", "give a number of rounds");
  Eigen::VectorXd values = long_call([&](const Progress& progress) -> Eigen::VectorXd {
    const Mesh surface = smooth > 0 ? smoothed(*input, smooth) : *input;
    if (!visibility) return vertex_means(surface, shape_diameter(surface, {}, progress).values);
    return continuous_visibility(surface, {.kind = *visibility, .weak_threshold = weak_threshold}, progress).values;
  });
  const py::ssize_t size = values.size();
  return array_out(std::move(values), {size});
}

struct Segments {
  py::array labels;
  int parts = 0;
  std::string borders;
  int clusters = 0;
  double smoothness = 0;
};

Segments segments_of(const py::object& mesh, const std::string& feature_name, const std::string& border_name,
                     int clusters, std::optional<double> smoothness, std::uint64_t seed) {
  const SharedMesh input = mesh_in(mesh);
  if (clusters < 0) throw InputError("clusters", "is below 0", "give a number of levels, or 0 for what was fitted");
  if (smoothness && !(*smoothness > 0)) throw InputError("smoothness", "is not above 0", "give a number above 0");
  const SegmentationSettings settings = {.feature = chosen("feature", feature_name, features),
                                         .borders = chosen("borders", border_name, borders),
                                         .clusters = clusters,
                                         .smoothness = smoothness.value_or(-1),
                                         .seed = seed};
  Segmentation found = long_call([&](const Progress& progress) { return segment(*input, settings, progress); });
  return {.labels = vector_out(std::move(found.labels)),
          .parts = found.parts,
          .borders = word_for(found.borders, borders),
          .clusters = found.clusters,
          .smoothness = found.smoothness};
}

struct MedialArrays {
  py::array points, radii;
};

MedialArrays medial(const py::object& mesh, double spacing, double least_angle) {
  const SharedMesh input = mesh_in(mesh);
  if (!(least_angle >= 0 && least_angle <= 180)) {
    throw InputError("least_angle", "is not from 0 to 180", "give degrees, 60 are usual");
  }
  const MedialSettings settings = {.spacing = spacing, .least_angle = least_angle * (std::numbers::pi / 180)};
  MedialSamples found = long_call([&](const Progress& progress) { return medial_samples(*input, settings, progress); });
  const py::ssize_t rows = found.points.rows();
  return {.points = array_out(std::move(found.points), {rows, 3}), .radii = vector_out(std::move(found.radii))};
}

}  // namespace

void add_surface_parts(py::module_& core) {
  core.def("feature", &feature, py::arg("mesh"), py::arg("kind"), py::kw_only(), py::arg("weak_threshold") = 0.1,
           py::arg("smooth") = 0,
           "How large the part about each vertex is: float64, one a vertex (docs/feature.md).\n\n"
           "kind: 'cvf', 'cvf-avg', 'cvf-strong', 'cvf-weak' (areas that are continuously visible), or 'sdf' (how "
           "thick the solid is).\n"
           "weak_threshold: of 'cvf-weak', a share of the bounding sphere's radius.\n"
           "smooth: rounds of smoothing of a noisy surface first.");

  py::class_<Segments>(core, "Segments", "Parts as people would cut them, from segment().")
      .def_readonly("labels", &Segments::labels, "The part of each face, int32.")
      .def_readonly("borders", &Segments::borders, "'plain' or 'learnt'.")
      .def_readonly("clusters", &Segments::clusters, "Levels of the feature that were told apart.")
      .def_readonly("smoothness", &Segments::smoothness, "How dear borders were.")
      .def("__len__", [](const Segments& segments) { return segments.parts; });
  core.def("segment", &segments_of, py::arg("mesh"), py::arg("feature") = "cvf-avg", py::kw_only(),
           py::arg("borders") = "automatic", py::arg("clusters") = 0, py::arg("smoothness") = py::none(),
           py::arg("seed") = 0,
           "Parts of a mesh as people would cut it, from a feature of its surface (docs/segment.md).\n\n"
           "feature: a kind of feature(). borders: 'automatic', 'plain' or 'learnt'.\n"
           "clusters, smoothness: left out, what was fitted to people's segmentations.");

  py::class_<MedialArrays>(core, "MedialSamples", "Points of the medial axis, from medial_samples().")
      .def_readonly("points", &MedialArrays::points, "n x 3 float64, centres of balls inside the surface.")
      .def_readonly("radii", &MedialArrays::radii, "n float64, their distances to the surface, model units.")
      .def("__len__", [](const MedialArrays& samples) { return samples.radii.shape(0); });
  core.def("medial_samples", &medial, py::arg("mesh"), py::kw_only(), py::arg("spacing") = MedialSettings().spacing,
           py::arg("least_angle") = 60.0,
           "Points of the medial axis of a mesh, with their distances from the surface (docs/feature.md).\n\n"
           "spacing: longer edges are halved first, a share of the bounding sphere's radius.\n"
           "least_angle: degrees between the two nearest points of the surface, seen from the sample.");
}

}  // namespace partwise::python
