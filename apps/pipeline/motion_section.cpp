#include <fmt/format.h>

#include <map>

#include "partwise/geometry/mesh_io.h"
#include "partwise/motion/planning_problem.h"
#include "partwise/motion/problem_fields.h"
#include "partwise/motion/world.h"
#include "pipeline/stages.h"

namespace partwise::pipeline {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* problem_file = "problem.json";

// What roadmaps and paths of a scene have in common.
class MotionPlanner {
 public:
  MotionPlanner(const Places& places, const std::string& place, const json& section)
      : places_(places), fields_(places.object(place, section)) {
    tolerance_ = fields_.number("tolerance", 0, 1e-4, 10);
    if (fields_.has("samples")) samples_ = fields_.whole("samples", 0, 1, 100000000);
    time_ = fields_.number("time", 60, 1e-3, 1e9);
    planner_ =
        fields_.choice<const char*>("planner", "svma", {{"svma", "svma"}, {"maprm", "maprm"}, {"umaprm", "umaprm"}});
    if (fields_.has("limit")) limit_ = fields_.whole("limit", 0, 1, 1000000000);
    if (fields_.has("scene") == fields_.has("obstacles")) {
      fields_.refuse("", "has not one of scene and obstacles", "give a file of a scene, or meshes of obstacles");
    }
    fields_.has("scene") ? plan_scene() : plan_obstacles();
    fields_.refuse_others();
    if (paths_ == 0 && (fields_.has("time") || fields_.has("planner"))) {
      fields_.refuse(fields_.has("time") ? "time" : "planner", "is of paths alone, and no start and goal are given",
                     "leave it out");
    }
  }

  std::vector<Job> jobs() const { return jobs_; }

 private:
  // A city, a mesh, or a problem's file.
  void plan_scene() {
    const fs::path scene = take_file(fields_, "scene", places_.folder);
    name_ = fields_.has("name") ? fields_.text("name") : scene.filename().string();
    const bool is_city = scene.extension() == ".geojson";
    if (limit_ > 0 && !is_city)
      fields_.refuse("limit", "keeps footprints of a city, which this is not", "leave it out");
    bool flat = is_city;
    if (!is_city && !is_mesh_file(scene)) {
      const PlanningProblem problem = read_planning_problem(scene);
      flat = !problem.footprints.empty();
      paths_ = problem.queries.size();
    }
    add_jobs({input(scene)}, {scene}, {}, flat);
  }

  // Meshes, and a robot that is one or more.
  void plan_obstacles() {
    name_ = fields_.text("name");
    // By their fields.
    std::map<std::string, std::vector<NamedFile>> meshes;
    meshes["obstacles"] = take_files(fields_, "obstacles", "except", places_.folder, is_mesh_file);
    fields_.find("except");
    if (fields_.has("robot")) meshes["robot"] = take_files(fields_, "robot", "", places_.folder, is_mesh_file);
    json problem = {{"name", name_}};
    for (const char* field : {"space", "bounds", "queries"}) {
      if (const json* given = fields_.find(field)) problem[field] = *given;
    }
    std::vector<fs::path> inputs;
    const auto named = [&](const auto& name_of) {
      json whole = problem;
      for (const auto& [field, files] : meshes) {
        for (const NamedFile& each : files) whole[field].push_back({{"mesh", name_of(each.file)}});
      }
      return whole;
    };
    for (const auto& [field, files] : meshes) {
      for (const NamedFile& each : files) inputs.push_back(each.file);
    }
    const json absolute = named([](const fs::path& file) { return file.string(); });
    paths_ = json_problem_at(absolute, places_.file, fields_.place_of(""), places_.folder).queries.size();
    for (const NamedFile& each : meshes["obstacles"]) jobs_.push_back(parts(each));
    // Each job of a scene lies as deep as the next, so that one text serves all.
    const json relative = named([&](const fs::path& file) { return places_.from(folder("roadmap"), file); });
    add_jobs({output(problem_file)}, inputs, {{problem_file, relative.dump(1) + "\n"}}, false);
  }

  Job parts(const NamedFile& mesh) const {
    Job job{.stage = "parts", .name = folder("parts") + "/" + mesh.name};
    const std::string tolerance = fmt::format("{}", tolerance_ > 0 ? tolerance_ : ProblemWorldSettings{}.tolerance);
    job.words = {plain("decompose"),   input(mesh.file), plain("--tolerance"), plain(tolerance), plain("--labels"),
                 output("labels.seg"), plain("--hulls"), output("hulls.obj"),  plain("--glb"),   output("parts.glb")};
    job.inputs = {mesh.file};
    job.outputs = {"labels.seg", "hulls.obj", "parts.glb"};
    return job;
  }

  void add_jobs(const std::vector<Word>& scene, const std::vector<fs::path>& inputs,
                const std::vector<GivenFile>& given, bool flat) {
    const std::string picture = flat ? "roadmap.svg" : "roadmap.glb";
    Job roadmap = job("roadmaps", "roadmap", "roadmap", scene, inputs, given);
    if (limit_ > 0) add(roadmap, "--limit", std::to_string(limit_));
    if (samples_ > 0) add(roadmap, "--samples", std::to_string(samples_));
    add_output(roadmap, "--samples-out", "samples.txt");
    add_output(roadmap, flat ? "--svg" : "--glb", picture);
    jobs_.push_back(roadmap);
    for (std::size_t i = 1; i <= paths_; ++i) {
      Job path = job("paths", "plan", fmt::format("path-{}", i), scene, inputs, given);
      add(path, "--query", std::to_string(i));
      add(path, "--planner", planner_);
      add(path, "--time", fmt::format("{}", time_));
      add_output(path, "--path", "path.txt");
      add_output(path, "--glb", "path.glb");
      jobs_.push_back(path);
    }
  }

  Job job(const char* stage, const char* verb, const std::string& name, const std::vector<Word>& scene,
          const std::vector<fs::path>& inputs, const std::vector<GivenFile>& given) const {
    Job job{.stage = stage, .name = folder(name), .words = {plain(verb)}, .inputs = inputs, .given = given};
    job.words.insert(job.words.end(), scene.begin(), scene.end());
    if (tolerance_ > 0) add(job, "--tolerance", fmt::format("{}", tolerance_));
    if (places_.seed != 0) add(job, "--seed", std::to_string(places_.seed));
    return job;
  }

  std::string folder(const std::string& name) const { return fmt::format("motion/{}/{}", name_, name); }

  static void add(Job& job, const char* option, std::string value) {
    job.words.push_back(plain(option));
    job.words.push_back(plain(std::move(value)));
  }
  static void add_output(Job& job, const char* option, const std::string& file) {
    job.words.push_back(plain(option));
    job.words.push_back(output(file));
    job.outputs.push_back(file);
  }

  const Places& places_;
  JsonFields fields_;
  std::string name_;
  double tolerance_ = 0, time_ = 60;
  const char* planner_ = "svma";
  int samples_ = 0, limit_ = 0;
  std::size_t paths_ = 0;
  std::vector<Job> jobs_;
};

}  // namespace

std::vector<Job> motion_section(const Places& places, const json& section) {
  if (!section.is_array() || section.empty()) {
    places.object("", json::object()).refuse("motion", "is no list", "write [{\"scene\": ...}]");
  }
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < section.size(); ++i) {
    const MotionPlanner planner(places, fmt::format("motion[{}]", i), section[i]);
    const std::vector<Job> more = planner.jobs();
    jobs.insert(jobs.end(), more.begin(), more.end());
  }
  return jobs;
}

}  // namespace partwise::pipeline
