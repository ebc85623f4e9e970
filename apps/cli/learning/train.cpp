// partwise train: a configuration to a trained network.

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "learning_verbs.h"
#include "options.h"
#include "partwise/editing/editing_training.h"
#include "partwise/learning/training_file.h"
#include "partwise/normals/prediction/normal_training.h"
#include "partwise/normals/prediction/scene_training.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct Options {
  std::string config, output;
  bool resume = false, check = false;
};

// One of the project's trainings, ready to run.
struct Training {
  std::filesystem::path output;
  std::function<TrainingReport(const Rank& rank, const Progress& progress)> run;
};

template <typename Of>
Training prepared(const Options& options, Of training,
                  TrainingReport (*run)(const Of&, const Rank&, bool, const Progress&)) {
  if (!options.output.empty()) training.loop.output = options.output;
  if (training.loop.output.empty() && !options.check) {
    throw InputError(options.config, "names no output folder", "give it \"output\", or the option -o");
  }
  const std::filesystem::path output = training.loop.output;
  return {output, [training = std::move(training), run, resume = options.resume](
                      const Rank& rank, const Progress& progress) { return run(training, rank, resume, progress); }};
}

Training read_config(const Options& options, const Run& run) {
  const std::string network = network_to_train(options.config);
  if (network == "normals") return prepared(options, read_normal_training(options.config, run.seed), train_normals);
  if (network == "editing" || network == "encoder_decoder")
    return prepared(options, read_editing_training(options.config, run.seed), train_editing);
  if (network == "scenes") return prepared(options, read_scene_training(options.config, run.seed), train_scenes);
  throw InputError(options.config, fmt::format("network \"{}\" is none that is known", network),
                   "write editing, encoder_decoder, normals or scenes");
}

// Every step asks for the same large tensors: what is freed stays with the process, where giving it back and having it
// cleared anew took 3.1 s a step instead of 0.85.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int never = std::numeric_limits<int>::max();
  mallopt(M_MMAP_THRESHOLD, never);
  mallopt(M_TRIM_THRESHOLD, never);
#endif
}

void train_network(const Options& options, Run& run) {
  run.outputs.add_input("CONFIG", options.config);
  const Training training = run.stage("read", [&] { return read_config(options, run); });
  if (options.check) {
    run.report["input"] = options.config;
    run.summary = options.config + ": as it should be";
    return;
  }
  const Rank rank = rank_from_environment();
  keep_freed_memory();
  run.if_stopped = "a checkpoint was written, and --resume goes on from there";
  const TrainingReport report = run.stage("train", [&] { return training.run(rank, run.progress); });
  run.report["step"] = report.step;
  run.report["loss"] = report.loss;
  if (std::isfinite(report.best)) run.report["validation_loss"] = report.best;
  run.report["rank"] = rank.rank;
  run.report["ranks"] = rank.size;
  run.report["input"] = options.config;
  run.report["output"] = training.output.string();
  run.summary = fmt::format("{}: {} steps, loss {:.5g}\nwrote into {}", options.config, report.step, report.loss,
                            training.output.string());
}

Action add(CLI::App& command) {
  const auto options = std::make_shared<Options>();
  command.add_option("CONFIG", options->config, "What is to be trained, on what, and how (.json)")
      ->required()
      ->type_name("");
  command.add_flag("--resume", options->resume, "Go on from the output folder's checkpoint, if there is one");
  command.add_flag("--check", options->check, "Read the configuration, say what is wrong with it, and train nothing");
  add_file(command, "-o", options->output, "The folder of the training, in place of the configuration's")
      ->type_name("DIR");
  return [options](Run& run) { train_network(*options, run); };
}

}  // namespace

const Verb train_verb = {
    .name = train_line.name,
    .summary = train_line.summary,
    .details =
        "Writes OUT/checkpoint.pt to go on from, OUT/best.pt with the least validation loss, OUT/log.jsonl, and event "
        "files\n"
        "for TensorBoard. Under torchrun, mpirun or srun processes share each batch. Stopped at any moment, --resume\n"
        "goes on, with the same losses. docs/training.md says what a configuration holds.",
    .example =
        "  partwise train examples/editing.json -o out/editing\n"
        "  partwise train examples/editing.json -o out/editing --resume",
    .add = add,
};

}  // namespace partwise::cli
