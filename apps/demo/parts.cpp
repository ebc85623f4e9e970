#include "parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "beside.h"
#include "cli/part_meshes.h"
#include "partwise/base/shared_files.h"
#include "partwise/geometry/mesh_io.h"
#include "pictures.h"

namespace demo {
namespace {

using Clock = std::chrono::steady_clock;

partwise::Decomposition timed_decompose(const partwise::Mesh& mesh, const partwise::DecompositionSettings& settings,
                                        Figures& figures) {
  const Clock::time_point start = Clock::now();
  partwise::Decomposition parts = partwise::decompose(mesh, settings);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  figures = {parts.parts(), parts.concavity, parts.volume_ratio, seconds};
  return parts;
}

Row figures_row(std::string_view measure, const Figures& figures) {
  return {std::string(measure), std::to_string(figures.parts),
          fmt::format("{:.3f} <small>R</small>", figures.concavity),
          std::isfinite(figures.volume_ratio) ? fmt::format("{:.2f}", figures.volume_ratio) : "open",
          fmt::format("{:.2f} <small>s</small>", figures.seconds)};
}

std::string model_article(const PartsStory::Row& row) {
  const Decomposed& model = *row.model;
  return fmt::format("<article>\n<h3>{}</h3>\n<p class=\"meta\">{} faces, {}</p>\n", model.model.name,
                     thousands(static_cast<std::uint64_t>(model.mesh.faces.rows())),
                     model.parts.watertight ? "closed" : "open") +
         figures(row.pictures, "row") +
         table({"measure", "parts", "concavity", "volume ratio", "time"},
               {figures_row("hull", model.hull), figures_row("valley", model.valley)}) +
         "</article>\n";
}

}  // namespace

Decomposed decompose_model(const Model& model, double tolerance) {
  Decomposed result;
  result.model = model;
  result.mesh = partwise::read_mesh(partwise::shared_file("data/models") / model.file);
  result.parts = timed_decompose(result.mesh, {.tolerance = tolerance}, result.hull);
  timed_decompose(result.mesh, {.tolerance = tolerance, .measure = partwise::ConcavityMeasure::valley}, result.valley);
  return result;
}

Turnable turnable_parts(const Decomposed& model) {
  constexpr double apart = 0.3;
  const partwise::Decomposition& parts = model.parts;
  std::vector<partwise::NamedMesh> meshes = partwise::cli::part_meshes(parts.mesh, parts.mesh_labels, parts.parts());
  partwise::PreviewScene still;
  const partwise::Point centre = middle(parts.mesh.vertices);
  for (const partwise::NamedMesh& each : meshes) {
    partwise::PreviewMesh& moved = still.meshes.emplace_back(partwise::PreviewMesh{each.mesh, {}, each.colour});
    moved.mesh.vertices.rowwise() += apart * (middle(each.mesh.vertices) - centre);
  }
  for (std::size_t i = 0; i < parts.hulls.size(); ++i)
    meshes.push_back({fmt::format("hull_{}", i), parts.hulls[i], meshes[i].colour});
  return make_turnable(still, meshes,
                       {.slider = Slider::apart, .label = "apart", .start = apart, .azimuth = model.model.azimuth},
                       fmt::format("{}: {} parts", model.model.name, parts.parts()),
                       fmt::format("{}, its parts moved apart", model.model.name));
}

std::string totals(const PartsStory& story) {
  int parts = 0, closed = 0;
  double ratio = 0, concavity = 0, seconds = 0;
  for (const PartsStory::Row& row : story.models) {
    const Figures& hull = row.model->hull;
    parts += hull.parts;
    concavity = std::max(concavity, hull.concavity);
    seconds += hull.seconds;
    if (!std::isfinite(hull.volume_ratio)) continue;
    ++closed;
    ratio += hull.volume_ratio;
  }
  const auto count = static_cast<double>(story.models.size());
  return fact("parts a model, mean", fmt::format("{:.1f}", parts / count)) +
         fact("hull volume to solid volume, mean of the closed", fmt::format("{:.2f}", ratio / std::max(1, closed))) +
         fact("largest concavity of any part", fmt::format("{:.3f}", concavity), "R") +
         fact("to decompose a model, mean", fmt::format("{:.2f}", seconds / count), "s");
}

std::string parts_chapter(const PartsStory& story) {
  std::string html = "<h2>One tolerance for all of them</h2>\n<div class=\"turns\">\n";
  for (std::size_t i = 0; i < story.turned.size(); ++i) html += figure(story.turned[i], fmt::format("model-{}", i));
  html += fmt::format(
      R"(</div>
<p>R is the radius of a model's bounding sphere, and the tolerance is {0:.2f} R. Every face belongs to one part, every part is
connected, and each hull encloses its part. What else is promised depends on the measure of concavity:</p>
<ul>
<li><b>hull</b>, which the pictures show: no point of any part's hull lies outside the solid by more than {0:.2f} R. An open mesh
has no inside: the distance is to its surface, so its hulls follow the shell, and there are more of them.</li>
<li><b>valley</b>, as published: between the ends of any edge of a part's hull, the shortest path on the part runs nowhere
deeper than {0:.2f} R below that edge, unless it keeps to the hull as the rim of a cup does.</li>
</ul>
<p>The volume ratio is the volume of the hulls' union over that of the solid; an open mesh has none.</p>
)",
      story.tolerance);
  for (const PartsStory::Row& row : story.models) html += model_article(row);
  return html + parts_beside();
}

std::string model_credits(const PartsStory& story) {
  std::string html = "<p>The models, all from the Sweet Home 3D furniture collections, stripped to their geometry: ";
  for (const PartsStory::Row& row : story.models) {
    const Model& model = row.model->model;
    html += fmt::format("{}{} by {} ({})", &row == story.models.data() ? "" : ", ", model.name, model.author,
                        model.licence);
  }
  return html +
         ". Licences: <a href=\"https://creativecommons.org/publicdomain/zero/1.0/\">CC0 1.0</a>, "
         "<a href=\"https://creativecommons.org/licenses/by/3.0/\">CC BY 3.0</a>.</p>\n";
}

}  // namespace demo
