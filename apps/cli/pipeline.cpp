// partwise pipeline: a configuration to all that it asks for, made or kept.

#include "pipeline/pipeline.h"

#include <fmt/format.h>

#include <memory>
#include <string>

#include "options.h"
#include "partwise/base/ranks.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string config, output;
  bool dry_run = false;
};

// Not where a job's verb would be one of several processes without knowing of the others.
void expect_one_process() {
  if (rank_from_environment().size == 1) return;
  throw InputError("the pipeline", "is one of several processes", "run it once, outside of mpirun, srun and torchrun");
}

void forecast(const Options& options, const pipeline::Plan& plan, const pipeline::PipelineSettings& settings,
              Run& run) {
  using State = pipeline::JobForecast::State;
  const auto jobs = run.stage("look", [&] { return pipeline::forecast_pipeline(plan, settings); });
  run.report["jobs"] = nlohmann::ordered_json::array();
  int kept = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const char* word = jobs[i].state == State::kept ? "keep" : jobs[i].state == State::made ? "make" : "open";
    kept += jobs[i].state == State::kept ? 1 : 0;
    run.report["jobs"].push_back({{"name", plan.jobs[i].name}, {"stage", plan.jobs[i].stage}, {"will", word}});
    if (jobs[i].state == State::kept) continue;
    run.report["jobs"].back()["why"] = jobs[i].reason;
    run.summary += jobs[i].state == State::made ? fmt::format("make {}: {}\n", plan.jobs[i].name, jobs[i].reason)
                                                : fmt::format("see  {}: after {}\n", plan.jobs[i].name, jobs[i].reason);
  }
  run.summary += fmt::format("{}: {} of {} jobs stand", options.config, kept, jobs.size());
}

void report(const Options& options, const pipeline::Plan& plan, const pipeline::PipelineReport& result, Run& run) {
  run.report["stages"] = nlohmann::ordered_json::array();
  run.summary = options.config + ":";
  for (const pipeline::StageReport& stage : result.stages) {
    run.report["stages"].push_back({{"name", stage.name},
                                    {"jobs", stage.jobs},
                                    {"made", stage.made},
                                    {"kept", stage.kept},
                                    {"failed", stage.failed},
                                    {"seconds", stage.seconds}});
    run.summary += fmt::format("\n  {:9} {} made in {:.1f} s, {} kept{}", stage.name, stage.made, stage.seconds,
                               stage.kept, stage.failed > 0 ? fmt::format(", {} left out", stage.failed) : "");
  }
  run.report["input"] = options.config;
  run.report["output"] = plan.output.string();
  run.summary += "\nwrote into " + plan.output.string();
}

[[noreturn]] void refuse(const Options& options, const pipeline::PipelineReport& result) {
  int jobs = 0, failed = 0, held = 0;
  for (const pipeline::StageReport& stage : result.stages) {
    jobs += stage.jobs;
    failed += stage.failed;
    held += stage.held;
  }
  throw InputError(options.config,
                   fmt::format("{} of {} jobs failed{}", failed, jobs,
                               held > 0 ? fmt::format(", {} more need what they make", held) : ""),
                   "mend what the lines above say and run it again, which goes on from here");
}

void run_config(const Options& options, Run& run) {
  run.outputs.add_input("CONFIG", options.config);
  expect_one_process();
  const pipeline::Plan plan = run.stage(
      "read", [&] { return pipeline::read_plan(options.config, options.output, static_cast<int>(run.seed)); });
  const pipeline::PipelineSettings settings{
      .program = std::filesystem::read_symlink("/proc/self/exe"), .version = PARTWISE_VERSION, .threads = run.threads};
  if (options.dry_run) return forecast(options, plan, settings, run);
  run.if_stopped = "what is done stays, and running it again goes on from there";
  const pipeline::PipelineReport result =
      run.stage("jobs", [&] { return pipeline::run_pipeline(plan, settings, run.say, run.progress); });
  if (!result.whole) refuse(options, result);
  report(options, plan, result, run);
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("CONFIG", options->config, "Which shapes, and what is to be made of them (.json)")
      ->required()
      ->type_name("");
  add_file(command, "-o", options->output, "The folder of all that is made, in place of the configuration's")
      ->type_name("DIR");
  command.add_flag("--dry-run", options->dry_run, "Make nothing; say what would be made, and why");
  return [options](Run& run) { run_config(*options, run); };
}

}  // namespace

const Verb pipeline_verb = {
    .name = "pipeline",
    .summary = "Folders of shapes to parts, images, networks, edits, normals, roadmaps and paths, each made once",
    .details =
        "Runs the other verbs over all that a configuration names, several at a time, and keeps what was made from "
        "the\n"
        "same before. Stopped at any moment, the same command goes on with the same bytes. OUT/manifest.json says "
        "what\n"
        "was made from what. docs/pipeline.md says what a configuration holds.",
    .example =
        "  partwise pipeline examples/pipeline.json -o out/pipeline\n"
        "  partwise pipeline examples/pipeline.json -o out/pipeline --dry-run",
    .add = add,
};

}  // namespace partwise::cli
