#include "pipeline/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

#include "partwise/base/error.h"
#include "partwise/geometry/mesh_io.h"
#include "pipeline/stages.h"

namespace partwise::pipeline {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

bool is_outline(const fs::path& file) {
  const std::set<std::string> endings = {".poly", ".svg", ".geojson", ".wkt", ".png"};
  return endings.contains(file.extension().string());
}

Places places_of(const fs::path& config, const fs::path& output, int seed, JsonFields& fields) {
  Places places;
  places.file = config;
  places.folder = fs::weakly_canonical(fs::absolute(config).parent_path());
  const int own_seed = fields.whole("seed", 0, 0, std::numeric_limits<int>::max());
  places.seed = seed != 0 ? seed : own_seed;
  const fs::path own_output = fields.has("output") ? places.folder / fields.text("output") : fs::path();
  if (output.empty() && own_output.empty()) {
    throw InputError(config.string(), "names no output folder", "give it \"output\", or the option -o");
  }
  places.output = fs::weakly_canonical(output.empty() ? own_output : fs::absolute(output));
  if (!places.output.has_filename()) places.output = places.output.parent_path();  // named with a slash
  return places;
}

void expect_names_apart(const std::vector<Job>& jobs, const fs::path& config) {
  std::set<std::string> names;
  for (const Job& job : jobs) {
    if (names.insert(job.name).second) continue;
    throw InputError(config.string(), fmt::format("asks twice for {}", job.name),
                     "drop one, or give scenes a \"name\" and photos different ones");
  }
}

class Planner {
 public:
  Planner(const fs::path& config, const fs::path& output, int seed)
      : whole_(read_json(config)),
        fields_(config.string(), "", whole_, page),
        places_(places_of(config, output, seed, fields_)) {}

  Plan plan() {
    plan_.config = places_.file;
    plan_.output = places_.output;
    plan_.leave_out_bad = fields_.choice<bool>("bad_shapes", false, {{"stop", false}, {"leave_out", true}});
    Shapes shapes;
    if (fields_.has("shapes")) shapes.solids = take_files(fields_, "shapes", "except", places_.folder, is_mesh_file);
    if (fields_.has("outlines")) shapes.outlines = take_files(fields_, "outlines", "", places_.folder, is_outline);
    if (!fields_.has("shapes") && fields_.has("except")) fields_.refuse("except", "has no shapes", "leave it out");
    fields_.find("except");
    PartsSection parts;
    if (const json* section = fields_.find("parts")) {
      parts = parts_section(places_, shapes, *section);
      add(parts.jobs);
    }
    if (const json* section = fields_.find("motion")) add(motion_section(places_, *section));
    const json* images = fields_.find("images");
    if (images != nullptr) add({images_section(places_, shapes, parts, plan_.leave_out_bad, *images)});
    const Networks networks =
        networks_sections(places_, images != nullptr, fields_.find("training"), fields_.find("weights"));
    add(networks.jobs);
    if (const json* section = fields_.find("photos")) add(photos_section(places_, networks, *section));
    fields_.refuse_others();
    if (plan_.jobs.empty()) fields_.refuse("", "asks for nothing", "give parts, images, training, photos or motion");
    expect_names_apart(plan_.jobs, places_.file);
    return std::move(plan_);
  }

 private:
  void add(const std::vector<Job>& jobs) {
    for (const Job& job : jobs) {
      if (std::ranges::find(plan_.stages, job.stage) == plan_.stages.end()) plan_.stages.push_back(job.stage);
      plan_.jobs.push_back(job);
    }
  }

  json whole_;
  JsonFields fields_;
  Places places_;
  Plan plan_;
};

}  // namespace

Plan read_plan(const fs::path& config, const fs::path& output, int seed) {
  return Planner(config, output, seed).plan();
}

}  // namespace partwise::pipeline
