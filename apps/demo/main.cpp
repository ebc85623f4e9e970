// partwise_demo OUT_DIR: decomposes the shipped models, draws them, lets copies of them fall into a heap, and writes
// OUT_DIR/index.html, a self-contained page, and OUT_DIR/heap.png, its first picture.

#include <fmt/format.h>
#include <tbb/info.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "page.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/shared_files.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/topology.h"
#include "partwise/imaging/png.h"
#include "pictures.h"

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

Decomposed tell_model(const demo::Model& model, double tolerance, demo::ModelStory& story) {
  Decomposed result;
  result.mesh = partwise::read_mesh(partwise::shared_file("data/models") / model.file);
  partwise::DecompositionSettings settings;
  settings.tolerance = tolerance;
  Clock::time_point start = Clock::now();
  result.parts = partwise::decompose(result.mesh, settings);
  story.seconds = seconds_since(start);
  settings.measure = partwise::ConcavityMeasure::valley;
  start = Clock::now();
  story.valley_parts = partwise::decompose(result.mesh, settings).parts();
  story.valley_seconds = seconds_since(start);

  story.model = model;
  story.faces = static_cast<int>(result.mesh.faces.rows());
  story.watertight = result.parts.watertight;
  story.parts = result.parts.parts();
  story.concavity = result.parts.concavity;
  story.volume_ratio = result.parts.volume_ratio;
  const demo::ModelPictures drawn = demo::draw_model(result.mesh, result.parts, model.azimuth);
  const auto add = [&](const partwise::Image& image, std::string caption, std::string_view shown) {
    story.pictures.push_back(demo::make_picture(image, std::move(caption), fmt::format("{}: {}", model.name, shown)));
  };
  add(drawn.input, "Input", "the mesh as it came");
  add(drawn.parts, fmt::format("{} parts", story.parts), "faces in the colours of their parts");
  add(drawn.hulls, "Their hulls, drawn apart", "the convex hull of each part");
  return result;
}

demo::PileStory tell_pile(const demo::PileSettings& settings, const demo::Pile& pile) {
  demo::PileStory story{settings.bodies, pile.hulls, settings.seconds, pile.seconds, pile.deepest, {}, {}, {}};
  for (std::size_t i = 0; i < pile.frames.size(); ++i) {
    const std::string when = fmt::format("after {:.1f} s", settings.frames[i]);
    story.falling.push_back(demo::make_picture(pile.frames[i], when, "Bodies falling, " + when));
  }
  story.heap = demo::make_picture(
      pile.heap, fmt::format("{} decomposed models at rest, simulated as {} convex hulls", settings.bodies, pile.hulls),
      "A heap of horses, chairs, cups and other models");
  story.heap_hulls = demo::make_picture(pile.heap_hulls, "The same heap as the physics engine sees it",
                                        "The same heap drawn as coloured convex hulls");
  return story;
}

void run(const std::filesystem::path& folder) {
  const Clock::time_point start = Clock::now();
  std::filesystem::create_directories(folder);
  demo::Story story;
  story.tolerance = 0.1;
  story.threads = tbb::info::default_concurrency();
  std::vector<Decomposed> decomposed;
  for (const demo::Model& model : demo::models()) {
    show(fmt::format("{} ({} of {})", model.name, story.models.size() + 1, demo::models().size()));
    decomposed.push_back(tell_model(model, story.tolerance, story.models.emplace_back()));
  }
  show("simulating the heap");
  std::vector<demo::PileKind> kinds;
  for (const Decomposed& model : decomposed) kinds.push_back({&model.mesh, &model.parts});
  const demo::PileSettings settings;
  const demo::Pile pile = demo::simulate_pile(kinds, settings);
  story.pile = tell_pile(settings, pile);
  story.seconds = seconds_since(start);
  partwise::write_png(folder / "heap.png", pile.heap);
  partwise::write_file(folder / "index.html", demo::make_page(story));
  show("");
  fmt::print("{} models and a heap of {} in {:.1f} s\n", story.models.size(), settings.bodies, story.seconds);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
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
