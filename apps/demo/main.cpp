// partwise_demo OUT_DIR: decomposes the shipped models and does with them what the library can, and writes
// OUT_DIR/index.html, one self-contained page, OUT_DIR/hero.png, four models, their parts and hulls in one picture,
// and, in a build with libtorch, OUT_DIR/edits.png, a picture of a car and edits of it.

#include <fmt/format.h>
#include <tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <future>

#include "cages.h"
#ifdef PARTWISE_DEMO_LEARNING
#include "edits.h"
#include "normals.h"
#include "scenes.h"
#endif
#include "heap.h"
#include "materials.h"
#include "motion.h"
#include "nets.h"
#include "outlines.h"
#include "page.h"
#include "parts.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/imaging/png.h"
#include "partwise/imaging/tile.h"
#include "pictures.h"
#include "repair.h"
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

// The decomposed models, by their names.
class Shelf {
 public:
  Shelf(std::span<const demo::Model> models, double tolerance) {
    for (const demo::Model& model : models) {
      show(fmt::format("decomposing: {} ({} of {})", model.name, models_.size() + 1, models.size()));
      models_.push_back(demo::decompose_model(model, tolerance));
    }
  }

  const std::vector<demo::Decomposed>& all() const { return models_; }

  const demo::Decomposed& operator[](std::string_view name) const {
    const auto found =
        std::ranges::find_if(models_, [&](const demo::Decomposed& each) { return each.model.name == name; });
    PARTWISE_CHECK(found == models_.end(), ==, false);
    return *found;
  }

  demo::WornModel worn(std::string_view name) const {
    const demo::Decomposed& model = (*this)[name];
    return {std::string(name), model.parts.mesh, model.parts.mesh_labels};
  }

 private:
  std::vector<demo::Decomposed> models_;
};

std::vector<demo::Picture> tell_pictures(const demo::Decomposed& model, const demo::ModelPictures& drawn) {
  std::vector<demo::Picture> pictures;
  const auto add = [&](const partwise::Image& image, std::string caption, std::string_view shown) {
    pictures.push_back(demo::make_picture(image, std::move(caption), fmt::format("{}: {}", model.model.name, shown)));
  };
  add(drawn.input, "Input", "the mesh as it came");
  const auto count = [](int number, std::string_view of) {
    return fmt::format("{} {}{}", number, of, number == 1 ? "" : "s");
  };
  add(drawn.ridges, count(drawn.ridge_count, "ridge") + ", " + count(drawn.valley_count, "valley"),
      "the deep valleys as lines, the convex ridges as beads");
  add(drawn.parts, count(model.parts.parts(), "part"), "faces in the colours of their parts");
  add(drawn.hulls, "Hulls, drawn apart", "the convex hull of each part");
  return pictures;
}

// A column a model: input, parts, hulls.
void write_hero(const std::filesystem::path& path, const std::vector<demo::ModelPictures>& models) {
  std::vector<partwise::Image> pictures;
  for (const auto row : {&demo::ModelPictures::input, &demo::ModelPictures::parts, &demo::ModelPictures::hulls}) {
    for (const demo::ModelPictures& model : models) pictures.push_back(model.*row);
  }
  partwise::write_png(path, partwise::tile(pictures, static_cast<int>(models.size())));
}

demo::PartsStory tell_parts(const Shelf& shelf, double tolerance, const std::filesystem::path& folder) {
  demo::PartsStory story{tolerance, {}, {}};
  std::vector<demo::ModelPictures> hero;
  for (const demo::Decomposed& model : shelf.all()) {
    show(fmt::format("drawing: {} ({} of {})", model.model.name, story.models.size() + 1, shelf.all().size()));
    demo::ModelPictures drawn = demo::draw_model(model.mesh, model.parts, model.model.azimuth);
    story.models.push_back({&model, tell_pictures(model, drawn)});
    if (model.model.in_hero) hero.push_back(std::move(drawn));
  }
  write_hero(folder / "hero.png", hero);
  for (const char* name : {"Horse", "Toy car"}) story.turned.push_back(demo::turnable_parts(shelf[name]));
  return story;
}

demo::OutlineStory tell_outlines(const Shelf& shelf) {
  std::vector<const partwise::Mesh*> herd;
  for (const demo::Decomposed& model : shelf.all()) {
    if (model.model.in_herd) herd.push_back(&model.mesh);
  }
  return demo::tell_outlines(herd);
}

demo::SurfacesStory tell_surfaces(const Shelf& shelf) {
  std::vector<demo::ShownModel> shown;
  for (const demo::Decomposed& model : shelf.all()) shown.push_back({&model.model, &model.mesh});
  return demo::tell_surfaces(shown);
}

demo::MaterialsStory tell_materials(const Shelf& shelf) {
  std::vector<demo::WornModel> worn;
  for (const demo::Decomposed& model : shelf.all()) worn.push_back(shelf.worn(model.model.name));
  return demo::tell_materials(worn, shelf.worn("Chair"), shelf.worn("Toy car"));
}

void run(const std::filesystem::path& folder) {
  const Clock::time_point start = Clock::now();
  constexpr double tolerance = 0.1;
  std::filesystem::create_directories(folder);
  const Shelf shelf(demo::models(), tolerance);
  // The simulation uses one core, so the models' pictures are drawn beside it.
  std::vector<demo::PileKind> kinds;
  for (const demo::Decomposed& model : shelf.all()) kinds.push_back({&model.mesh, &model.parts});
  const demo::PileSettings settings;
  std::future<demo::Pile> pile = std::async(std::launch::async, [&] { return demo::simulate_pile(kinds, settings); });
  const demo::PartsStory parts = tell_parts(shelf, tolerance, folder);

  demo::Page page;
  const auto add = [&](std::string_view id, std::string_view name, std::string html) {
    page.chapters.push_back({id, name, std::move(html)});
  };
  add("parts", "Parts", parts_chapter(parts));
  show("simulating and drawing the heap");
  const demo::HeapStory heap = demo::tell_heap(settings, pile.get());
  add("heap", "Simulation", heap_chapter(heap));
  show("cutting outlines");
  add("outlines", "In the plane", outlines_chapter(tell_outlines(shelf)));
  show("looking at surfaces");
  add("surfaces", "As people see them", surfaces_chapter(tell_surfaces(shelf)));
  show("putting the horse into a cage");
  const demo::Decomposed &horse = shelf["Horse"], &dog = shelf["Dog"];
  add("cage", "Cages", cages_chapter(demo::tell_cages(horse.mesh, horse.model.azimuth)));
  show("repairing");
  add("repair", "Repair", repair_chapter(demo::tell_repair(horse.mesh, horse.model.azimuth)));
  show("unfolding");
  add("nets", "Nets", nets_chapter(demo::tell_nets(dog.mesh, dog.model.azimuth)));
  show("putting materials on");
  const demo::MaterialsStory materials = tell_materials(shelf);
  add("materials", "Materials", materials_chapter(materials));
  const auto car_row = [](const demo::PartsStory::Row& row) { return row.model->model.name == "Toy car"; };
  const std::vector<demo::Picture>& car = std::ranges::find_if(parts.models, car_row)->pictures;
  page.story = {
      {"parts", "Shapes", car[0]}, {"parts", "Parts", car[2]}, {"materials", "Appearance", materials.channels[0]}};
#ifdef PARTWISE_DEMO_LEARNING
  show("editing pictures");
  const std::vector<demo::WornModel> swapped = {shelf.worn("Toy car"), shelf.worn("Teddy bear"), shelf.worn("Jar"),
                                                shelf.worn("Horse")};
  const demo::EditsStory edits = demo::tell_edits(shelf.worn("Toy car"), shelf.worn("Chair"), swapped);
  partwise::write_png(folder / "edits.png", edits.strip);
  add("edits", "Edits", edits_chapter(edits));
  show("finding normals");
  const std::vector<demo::WornModel> looked_at = {shelf.worn("Toy car"), shelf.worn("Teddy bear"),
                                                  shelf.worn("Coffee cup")};
  const demo::NormalsStory normals = demo::tell_normals(looked_at);
  add("normals", "Normals", normals_chapter(normals));
  page.story.push_back({"normals", "Shape from a photo", normals.pictures[1]});
  show("looking at rooms");
  const std::vector<demo::WornModel> furniture = {shelf.worn("Chair"), shelf.worn("Table"), shelf.worn("Rocking horse"),
                                                  shelf.worn("Dog"), shelf.worn("Jar")};
  add("scenes", "Rooms", scenes_chapter(demo::tell_scenes(furniture)));
#endif
  show("finding ways");
  const demo::MotionStory motion = demo::tell_motion();
  add("motion", "Motion", motion_chapter(motion));
  page.story.push_back({"motion", "Motion", motion.window.still});

  page.hero = heap.heap;
  page.facts = totals(parts);
  page.credits = model_credits(parts) + demo::outline_credits() + demo::material_credits() + demo::motion_credits();
  page.threads = tbb::info::default_concurrency();
  page.seconds = seconds_since(start);
  partwise::write_file(folder / "index.html", make_page(page));
  show("");
  fmt::print("{} models and a heap of {} in {:.1f} s: {}\n", shelf.all().size(), settings.bodies, page.seconds,
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
