// The program `partwise`, and partwise-learning: options, threads, messages and exit codes that all verbs share. Which
// verbs there are is said by the verbs.cpp that it is linked with.
//
// Exit 0: done, and every output that was asked for is there. 1: cannot be done. 2: wrong usage. 130, 143: stopped by
// Ctrl-C or a termination signal. Unless the exit is 0 nothing was written and standard error has one line that says
// why; only `pipeline` keeps what is done, and has a line for each job that failed.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "learning_verbs.h"
#include "options.h"
#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_log.h"
#include "progress_line.h"
#include "run.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

constexpr int exit_cannot = 1;
constexpr int exit_usage = 2;
constexpr int exit_signal = 128;

struct CommonOptions {
  int threads = 0;
  int seed = 0;
  bool quiet = false;
  std::string json;
};

struct Command {
  CLI::App* app = nullptr;
  Action action;
  CommonOptions common;
};

// One line on standard error, whatever is in file names or in messages of libraries.
void say(std::string message) {
  std::ranges::replace_if(
      message, [](unsigned char c) { return c < ' ' || c == 127; }, ' ');
  fmt::print(stderr, "partwise: {}\n", message);
}

void add_common_options(CLI::App& app, CommonOptions& common) {
  add_count(app, "--threads", common.threads, 1, "Use at most N threads [all cores]");
  add_count(app, "--seed", common.seed, 0, "Start of whatever is drawn by chance; the same seed, the same bytes [0]");
  app.add_flag("--quiet", common.quiet, "No progress and no summary");
  add_file(app, "--json", common.json, "Write a report of one JSON object; - for standard output");
}

std::unique_ptr<Command> add_command(CLI::App& program, const Verb& verb) {
  auto command = std::make_unique<Command>();
  command->app = program.add_subcommand(verb.name, verb.summary);
  command->app->group("Verbs");
  command->app->footer(fmt::format("{}\n\nExample:\n{}", verb.details, verb.example));
  command->action = verb.add(*command->app);
  add_common_options(*command->app, command->common);
  return command;
}

void finish(Run& run, const CommonOptions& common, std::chrono::steady_clock::time_point start) {
  const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
  run.seconds["total"] = total.count();
  run.report["seconds"] = run.seconds;
  run.report["reads"] = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : files_read()) run.report["reads"].push_back(file.string());
  const std::string json =
      run.report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";  // names may be no UTF-8
  if (!common.json.empty() && common.json != "-") write_file(run.outputs.staged("--json"), json);
  run.progress("writing", 1);
  run.outputs.commit();
  if (common.json == "-") {
    std::cout << json;
  } else if (!common.quiet) {
    std::cout << run.summary << "\n";
  }
  std::cout.flush();
  if (!std::cout) throw InputError("standard output", "cannot be written", "free some space or close no pipe early");
}

int execute(const Command& command) {
  const auto start = std::chrono::steady_clock::now();
  const CommonOptions& common = command.common;
  std::optional<tbb::global_control> threads;
  if (common.threads > 0) {
    threads.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(common.threads));
  }
  catch_stop_signals();
  if (!common.json.empty()) keep_read_log();
  ProgressLine line(common.quiet);
  Run run;
  try {
    run.seed = static_cast<std::uint64_t>(common.seed);
    run.threads = common.threads > 0 ? common.threads : tbb::this_task_arena::max_concurrency();
    run.progress = line.progress();
    run.say = [&](const std::string& message) {
      line.wipe();
      say(message);
    };
    if (!common.json.empty() && common.json != "-") run.outputs.add("--json", common.json);
    command.action(run);
    line.wipe();
    finish(run, common, start);
    return 0;
  } catch (const UsageError& error) {
    line.wipe();
    say(fmt::format("{}; see partwise {} --help", error.what(), command.app->get_name()));
    return exit_usage;
  } catch (const Cancelled& error) {
    line.wipe();
    say(fmt::format("{}; {}", error.what(), run.if_stopped));
    return exit_signal + stop_signal();
  } catch (const std::bad_alloc&) {
    line.wipe();
    say("out of memory; give it a smaller input or more memory");
  } catch (const CheckFailed& error) {
    line.wipe();
    say(fmt::format("a mistake in partwise itself: {}; please report it with the input", error.what()));
  } catch (const std::exception& error) {
    line.wipe();
    say(error.what());
  }
  return exit_cannot;
}

int parse_and_execute(int argc, char** argv) {
  const std::span<const LearningVerb> elsewhere = verbs_elsewhere();
  const auto is_asked_for = [&](const LearningVerb& verb) {
    return argc > 1 && std::string_view(argv[1]) == verb.name;
  };
  if (std::ranges::any_of(elsewhere, is_asked_for)) return become_learning_program(argv);
  CLI::App program("Turns shapes into parts.", "partwise");
  program.set_version_flag("--version", "partwise " PARTWISE_VERSION "\n" PARTWISE_BUILD "\n" PARTWISE_PEERS,
                           "Print the version, how it was built, and with what");
  program.get_formatter()->label("SUBCOMMAND", "VERB");
  program.get_formatter()->label("REQUIRED", "(required)");
  program.footer("partwise VERB --help says more and gives an example.");
  std::vector<std::unique_ptr<Command>> commands;
  commands.reserve(verbs().size());
  for (const Verb* verb : verbs()) commands.push_back(add_command(program, *verb));
  for (const LearningVerb& verb : elsewhere) program.add_subcommand(verb.name, verb.summary)->group("Verbs");

  const Command* chosen = nullptr;
  try {
    program.parse(argc, argv);
    for (const auto& command : commands) {
      if (command->app->parsed()) chosen = command.get();
    }
    if (chosen == nullptr) throw CLI::RequiredError("a verb");
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    const std::vector<CLI::App*> parsed = program.get_subcommands();
    const std::string verb = parsed.empty() ? "" : parsed.front()->get_name() + " ";
    say(fmt::format("{}; see partwise {}--help", error.what(), verb));
    return exit_usage;
  }
  return execute(*chosen);
}

}  // namespace
}  // namespace partwise::cli

int main(int argc, char** argv) {
  try {
    return partwise::cli::parse_and_execute(argc, argv);
  } catch (const std::exception& error) {
    partwise::cli::say(error.what());
    return partwise::cli::exit_cannot;
  }
}
