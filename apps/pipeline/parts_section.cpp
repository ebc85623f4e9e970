#include <fmt/format.h>

#include <functional>
#include <utility>

#include "pipeline/stages.h"

namespace partwise::pipeline {
namespace {

constexpr double least_tolerance = 1e-4, largest_tolerance = 10;
constexpr int most_parts = 1000000;

const char* word_of(MeshParts which) { return which == MeshParts::convex ? "convex" : "meaningful"; }

// The options of a verb that a section sets, each under its own name with _ for -.
class Options {
 public:
  explicit Options(JsonFields fields) : fields_(std::move(fields)) {}

  void tolerance() {
    fields_.need("tolerance");
    add("--tolerance", fmt::format("{}", fields_.number("tolerance", 0, least_tolerance, largest_tolerance)));
  }
  void number(const char* field, const char* option, double least, double most) {
    if (fields_.has(field)) add(option, fmt::format("{}", fields_.number(field, 0, least, most)));
  }
  void whole(const char* field, const char* option, int least) {
    if (fields_.has(field)) add(option, std::to_string(fields_.whole(field, 0, least, most_parts)));
  }
  void word(const char* field, const char* option, const char* otherwise,
            std::initializer_list<std::pair<const char*, const char*>> words) {
    const char* chosen = fields_.choice<const char*>(field, otherwise, words);
    if (chosen != nullptr) add(option, chosen);
  }
  void add(const char* option, std::string value) {
    words_.push_back(plain(option));
    words_.push_back(plain(std::move(value)));
  }
  std::vector<Word> words() const {
    fields_.refuse_others();
    return words_;
  }

 private:
  JsonFields fields_;
  std::vector<Word> words_;
};

std::vector<Word> convex_options(const Places& places, const nlohmann::json& value) {
  Options options(places.object("parts.convex", value));
  options.tolerance();
  options.word("measure", "--measure", nullptr, {{"hull", "hull"}, {"valley", "valley"}});
  options.whole("max_hulls", "--max-hulls", 1);
  options.whole("max_hull_vertices", "--max-hull-vertices", 4);
  return options.words();
}

std::vector<Word> meaningful_options(const Places& places, const nlohmann::json& value) {
  Options options(places.object("parts.meaningful", value));
  options.word(
      "feature", "--feature", "cvf-avg",
      {{"cvf-avg", "cvf-avg"}, {"cvf", "cvf"}, {"cvf-strong", "cvf-strong"}, {"cvf-weak", "cvf-weak"}, {"sdf", "sdf"}});
  options.whole("clusters", "--clusters", 1);
  options.number("smoothness", "--smoothness", 1e-9, 1e9);
  if (places.seed != 0) options.add("--seed", std::to_string(places.seed));
  return options.words();
}

std::vector<Word> planar_options(const Places& places, const nlohmann::json& value) {
  Options options(places.object("parts.planar", value));
  options.tolerance();
  return options.words();
}

using Outputs = std::vector<std::pair<const char*, const char*>>;  // options and their files

Job parts_job(const char* verb, const NamedFile& shape, std::string name, const std::vector<Word>& options,
              const Outputs& outputs) {
  Job job{.stage = "parts", .name = std::move(name), .words = {plain(verb), input(shape.file)}};
  job.inputs = {shape.file};
  job.words.insert(job.words.end(), options.begin(), options.end());
  for (const auto& [option, file] : outputs) {
    job.words.push_back(plain(option));
    job.words.push_back(output(file));
    job.outputs.emplace_back(file);
  }
  return job;
}

}  // namespace

std::string parts_folder(const NamedFile& mesh, MeshParts which) {
  return fmt::format("parts/{}/{}", mesh.name, word_of(which));
}

PartsSection parts_section(const Places& places, const Shapes& shapes, const nlohmann::json& section) {
  JsonFields fields = places.object("parts", section);
  const nlohmann::json* convex = fields.find("convex");
  const nlohmann::json* meaningful = fields.find("meaningful");
  const nlohmann::json* planar = fields.find("planar");
  fields.refuse_others();
  if (convex == nullptr && meaningful == nullptr && planar == nullptr) {
    fields.refuse("", "asks for nothing", "give \"convex\", \"meaningful\" or \"planar\"");
  }
  if (shapes.solids.empty() && (convex != nullptr || meaningful != nullptr)) {
    fields.refuse(convex != nullptr ? "convex" : "meaningful", "has no meshes to take apart",
                  "name some in \"shapes\"");
  }
  if (shapes.outlines.empty() && planar != nullptr) {
    fields.refuse("planar", "has no shapes to take apart", "name some in \"outlines\"");
  }
  PartsSection result{.has_convex = convex != nullptr, .has_meaningful = meaningful != nullptr};
  const std::vector<Word> of_convex = convex != nullptr ? convex_options(places, *convex) : std::vector<Word>();
  const std::vector<Word> of_meaningful =
      meaningful != nullptr ? meaningful_options(places, *meaningful) : std::vector<Word>();
  for (const NamedFile& mesh : shapes.solids) {
    if (convex != nullptr) {
      result.jobs.push_back(parts_job("decompose", mesh, parts_folder(mesh, MeshParts::convex), of_convex,
                                      {{"--labels", "labels.seg"}, {"--hulls", "hulls.obj"}, {"--glb", "parts.glb"}}));
    }
    if (meaningful != nullptr) {
      result.jobs.push_back(parts_job("segment", mesh, parts_folder(mesh, MeshParts::meaningful), of_meaningful,
                                      {{"--labels", "labels.seg"}, {"--glb", "parts.glb"}}));
    }
  }
  if (planar == nullptr) return result;
  const std::vector<Word> of_planar = planar_options(places, *planar);
  for (const NamedFile& outline : shapes.outlines) {
    result.jobs.push_back(
        parts_job("outline", outline, fmt::format("parts/{}/planar", outline.name), of_planar,
                  {{"--parts", "parts.geojson"}, {"--svg", "parts.svg"}, {"--skeleton", "skeleton.svg"}}));
  }
  return result;
}

}  // namespace partwise::pipeline
