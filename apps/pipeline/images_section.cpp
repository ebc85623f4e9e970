#include <algorithm>
#include <iterator>
#include <memory>

#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/appearance/synthesis/dataset_fields.h"
#include "partwise/appearance/synthesis/file_patterns.h"
#include "pipeline/stages.h"

namespace partwise::pipeline {
namespace {

using nlohmann::json;

constexpr const char* folder = "images";
constexpr const char* config_file = "configuration.json";

std::string as_pattern(const std::string& name) { return is_pattern(name) ? plain_pattern(name) : name; }

class ImagesPlanner {
 public:
  ImagesPlanner(const Places& places, const Shapes& shapes, const PartsSection& parts, const json& section)
      : places_(places), meshes_(shapes.solids), own_(section) {
    JsonFields fields = places.object(folder, section);
    for (const char* name : {"shapes", "output"}) {
      if (fields.has(name)) fields.refuse(name, "is the pipeline's affair", "leave it out here");
    }
    take_rule(fields, parts);
    if (meshes_.empty()) fields.refuse("", "has no meshes to show", "name some in \"shapes\"");
    if (!own_.contains("seed") && places.seed != 0) own_["seed"] = places.seed;
    resolve();
  }

  Job job(const std::vector<NamedFile>& meshes) const {
    json config = own_;
    config["shapes"] = json::array();
    Job job{
        .stage = folder, .name = folder, .words = {plain("dataset"), output(config_file), plain("-o"), output(".")}};
    for (const NamedFile& mesh : meshes) {
      const std::string name = places_.from(folder, mesh.file);
      job.inputs.push_back(mesh.file);
      if (by_labels_) {
        job.inputs.push_back(labels(mesh));
        config["shapes"].push_back({{"mesh", name}, {"labels", places_.from(folder, labels(mesh))}});
      } else {
        config["shapes"].push_back(as_pattern(name));
      }
    }
    job.inputs.insert(job.inputs.end(), files_.begin(), files_.end());
    job.given = {{config_file, config.dump(1) + "\n"}};
    job.outputs = {"dataset.json", "shard-000000.tar"};
    job.goes_on = job.wide = true;
    return job;
  }

  // Those whose labels are there.
  std::vector<NamedFile> without(const std::set<std::string>& failed) const {
    std::vector<NamedFile> left;
    std::ranges::copy_if(meshes_, std::back_inserter(left),
                         [&](const NamedFile& mesh) { return !failed.contains(parts_folder(mesh, rule_)); });
    if (left.empty()) throw InputError(folder, "no shape has parts", "mend those that the lines above name");
    return left;
  }

  const std::vector<NamedFile>& meshes() const { return meshes_; }

 private:
  void take_rule(JsonFields& fields, const PartsSection& parts) {
    const std::string rule = own_.contains("parts") ? fields.text("parts")
                             : parts.has_meaningful ? "meaningful"
                             : parts.has_convex     ? "convex"
                                                    : "components";
    if (rule == "cvf" || rule == "corise" || rule == "labels") {
      fields.refuse("parts", "is \"" + rule + "\", which the pipeline makes by itself",
                    "write \"meaningful\" or \"convex\" for those of the section \"parts\"");
    }
    if (rule != "meaningful" && rule != "convex") {
      own_["parts"] = rule;
      return;
    }
    rule_ = rule == "convex" ? MeshParts::convex : MeshParts::meaningful;
    if (!(rule_ == MeshParts::convex ? parts.has_convex : parts.has_meaningful)) {
      fields.refuse("parts", "is \"" + rule + "\", which nobody makes", "add \"parts\": {\"" + rule + "\": {...}}");
    }
    by_labels_ = true;
    own_["parts"] = "labels";
  }

  // Checks the section as a data set's, finds the files that its patterns name, and names them as the job has to.
  void resolve() {
    json checked = own_;
    if (by_labels_) checked["parts"] = "components";
    checked["shapes"] = json::array();
    for (const NamedFile& mesh : meshes_) checked["shapes"].push_back(as_pattern(mesh.file.string()));
    const DatasetConfig config = dataset_config_at(checked, places_.file, folder, places_.folder);
    rename("materials", config.materials, is_material_file);
    rename("lights", config.lights, is_light_file);
  }

  void rename(const char* field, const std::vector<std::string>& names, bool (*is_file)(const std::string&)) {
    if (own_[field].is_string() && std::ranges::none_of(names, is_file)) return;  // "all", "training"
    own_[field] = json::array();
    for (const std::string& name : names) {
      if (!is_file(name)) {
        own_[field].push_back(name);
        continue;
      }
      files_.push_back(absolute_file(places_.folder, name));
      own_[field].push_back(as_pattern(places_.from(folder, files_.back())));
    }
  }

  std::filesystem::path labels(const NamedFile& mesh) const {
    return places_.output / parts_folder(mesh, rule_) / "labels.seg";
  }

  Places places_;
  std::vector<NamedFile> meshes_;
  json own_;
  bool by_labels_ = false;
  MeshParts rule_ = MeshParts::meaningful;
  std::vector<std::filesystem::path> files_;
};

}  // namespace

Job images_section(const Places& places, const Shapes& shapes, const PartsSection& parts, bool leave_out_bad,
                   const json& section) {
  const auto planner = std::make_shared<const ImagesPlanner>(places, shapes, parts, section);
  Job job = planner->job(planner->meshes());
  if (leave_out_bad) {
    job.without = [planner](const std::set<std::string>& failed) { return planner->job(planner->without(failed)); };
  }
  return job;
}

}  // namespace partwise::pipeline
