// partwise_demo OUT_DIR: decomposes the shipped models, draws them, lets copies of them fall into a heap, and writes
// OUT_DIR/index.html, materials.html, motion.html and, in a build with libtorch, edits.html, self-contained pages,
// OUT_DIR/hero.png, four models, their parts and hulls in one picture, and OUT_DIR/edits.png, a picture of a car and
// edits of it.

#include <fmt/format.h>
#include <tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <future>

#ifdef PARTWISE_DEMO_EDITS
#include "edits.h"
#endif
#include "materials.h"
#include "motion.h"
#include "outlines.h"
#include "page.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/shared_files.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/imaging/png.h"
#include "partwise/imaging/tile.h"
#include "pictures.h"
#include "surfaces.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// One line that is rewritten on a terminal; nothing in a pipe.
void show(const std::string& what) {
  if (!::isatty(STDOUT_FILENO)) return;
  fmt::print("\r\033[K{}", what);
  std::fflush(stdout);
}

struct Decomposed {
  partwise::Mesh mesh;
  partwise::Decomposition parts;
};

partwise::Decomposition timed_decompose(const partwise::Mesh& mesh, const partwise::DecompositionSettings& settings,
                                        demo::Figures& figures) {
  const Clock::time_point start = Clock::now();
  partwise::Decomposition parts = partwise::decompose(mesh, settings);
  figures = {parts.parts(), parts.concavity, parts.volume_ratio, seconds_since(start)};
  return parts;
}

Decomposed decompose_model(const demo::Model& model, double tolerance, demo::ModelStory& story) {
  Decomposed result;
  result.mesh = partwise::read_mesh(partwise::shared_file("data/models") / model.file);
  result.parts = timed_decompose(result.mesh, {.tolerance = tolerance}, story.hull);
  timed_decompose(result.mesh, {.tolerance = tolerance, .measure = partwise::ConcavityMeasure::valley}, story.valley);
  story.model = model;
  story.faces = static_cast<int>(result.mesh.faces.rows());
  story.watertight = result.parts.watertight;
  return result;
}

std::vector<demo::Picture> tell_pictures(const demo::Model& model, const Decomposed& decomposed,
                                         const demo::ModelPictures& drawn) {
  std::vector<demo::Picture> pictures;
  const auto add = [&](const partwise::Image& image, std::string caption, std::string_view shown) {
    pictures.push_back(demo::make_picture(image, std::move(caption), fmt::format("{}: {}", model.name, shown)));
  };
  add(drawn.input, "Input", "the mesh as it came");
  const auto count = [](int number, std::string_view of) {
    return fmt::format("{} {}{}", number, of, number == 1 ? "" : "s");
  };
  add(drawn.ridges, count(drawn.ridge_count, "ridge") + ", " + count(drawn.valley_count, "valley"),
      "the deep valleys as lines, the convex ridges as beads");
  add(drawn.parts, count(decomposed.parts.parts(), "part"), "faces in the colours of their parts");
  add(drawn.hulls, "Hulls, drawn apart", "the convex hull of each part");
  return pictures;
}

demo::PileStory tell_pile(const demo::PileSettings& settings, const demo::Pile& pile) {
  demo::PileStory story{settings.bodies, pile.hulls, settings.seconds, pile.seconds, pile.deepest, {}, {}, {}};
  const demo::PilePictures drawn = demo::draw_pile(pile, settings);
  for (std::size_t i = 0; i < drawn.falling.size(); ++i) {
    const std::string when = fmt::format("after {:.1f} s", settings.frames[i]);
    story.falling.push_back(demo::make_picture(drawn.falling[i], when, "Bodies falling, " + when));
  }
  story.heap = demo::make_picture(
      drawn.heap,
      fmt::format("{} decomposed models at rest, simulated as {} convex hulls", settings.bodies, pile.hulls),
      "A heap of horses, chairs, cups and other models");
  story.heap_hulls = demo::make_picture(drawn.heap_hulls, "The same heap as the physics engine sees it",
                                        "The same heap drawn as coloured convex hulls");
  return story;
}

// A column a model: input, parts, hulls.
void write_hero(const std::filesystem::path& path, const std::vector<demo::ModelPictures>& models) {
  std::vector<partwise::Image> pictures;
  for (const auto row : {&demo::ModelPictures::input, &demo::ModelPictures::parts, &demo::ModelPictures::hulls}) {
    for (const demo::ModelPictures& model : models) pictures.push_back(model.*row);
  }
  partwise::write_png(path, partwise::tile(pictures, static_cast<int>(models.size())));
}

void run(const std::filesystem::path& folder) {
  const Clock::time_point start = Clock::now();
  std::filesystem::create_directories(folder);
  demo::Story story;
  story.tolerance = 0.1;
  story.threads = tbb::info::default_concurrency();
  const std::span<const demo::Model> models = demo::models();
  std::vector<Decomposed> decomposed;
  for (const demo::Model& model : models) {
    show(fmt::format("decomposing: {} ({} of {})", model.name, decomposed.size() + 1, models.size()));
    decomposed.push_back(decompose_model(model, story.tolerance, story.models.emplace_back()));
  }
  // The simulation uses one core, so the models' pictures are drawn beside it.
  std::vector<demo::PileKind> kinds;
  kinds.reserve(decomposed.size());
  for (const Decomposed& model : decomposed) kinds.push_back({&model.mesh, &model.parts});
  const demo::PileSettings settings;
  std::future<demo::Pile> pile = std::async(std::launch::async, [&] { return demo::simulate_pile(kinds, settings); });
  std::vector<demo::ModelPictures> hero;
  for (std::size_t i = 0; i < models.size(); ++i) {
    show(fmt::format("drawing: {} ({} of {})", models[i].name, i + 1, models.size()));
    demo::ModelPictures drawn = demo::draw_model(decomposed[i].mesh, decomposed[i].parts, models[i].azimuth);
    story.models[i].pictures = tell_pictures(models[i], decomposed[i], drawn);
    if (models[i].in_hero) hero.push_back(std::move(drawn));
  }
  show("cutting outlines");
  std::vector<const partwise::Mesh*> herd;
  for (std::size_t i = 0; i < models.size(); ++i) {
    if (models[i].in_herd) herd.push_back(&decomposed[i].mesh);
  }
  story.outlines = demo::tell_outlines(herd);
  show("looking at surfaces");
  std::vector<demo::ShownModel> shown;
  shown.reserve(models.size());
  for (std::size_t i = 0; i < models.size(); ++i) shown.push_back({&models[i], &decomposed[i].mesh});
  story.surfaces = demo::tell_surfaces(shown);
  show("putting materials on");
  std::vector<demo::WornModel> worn;
  for (std::size_t i = 0; i < models.size(); ++i)
    worn.push_back({std::string(models[i].name), decomposed[i].parts.mesh, decomposed[i].parts.mesh_labels});
  const auto named = [&](std::string_view name) {
    return *std::ranges::find_if(worn, [&](const demo::WornModel& model) { return model.name == name; });
  };
  const demo::MaterialsStory materials = demo::tell_materials(worn, named("Chair"), named("Toy car"));
  partwise::write_file(folder / "materials.html", demo::make_materials_page(materials));
  story.others.push_back({"materials.html", "Parts in real materials, under real light"});
#ifdef PARTWISE_DEMO_EDITS
  show("editing pictures");
  const std::vector<demo::WornModel> swapped = {named("Toy car"), named("Teddy bear"), named("Jar"), named("Horse")};
  const demo::EditsStory edits = demo::tell_edits(named("Toy car"), named("Chair"), swapped);
  partwise::write_png(folder / "edits.png", edits.strip);
  partwise::write_file(folder / "edits.html", demo::make_edits_page(edits));
  story.others.push_back({"edits.html", "One picture in, any material out"});
#endif
  show("finding ways");
  partwise::write_file(folder / "motion.html", demo::make_motion_page(demo::tell_motion()));
  story.others.push_back({"motion.html", "Ways that keep their distance"});
  show("simulating and drawing the heap");
  story.pile = tell_pile(settings, pile.get());
  story.seconds = seconds_since(start);
  write_hero(folder / "hero.png", hero);
  partwise::write_file(folder / "index.html", demo::make_page(story));
  show("");
  fmt::print("{} models and a heap of {} in {:.1f} s: {}\n", models.size(), settings.bodies, story.seconds,
             (folder / "index.html").string());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {  // --help is no folder
    fmt::print(stderr, "usage: partwise_demo OUT_DIR\n");
    return 2;
  }
  try {
    run(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "partwise_demo: {}\n", error.what());
    return 1;
  }
}
