// partwise material: the fit of measured materials, and those that ship.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "partwise/appearance/material/fit_dsbrdf.h"
#include "partwise/appearance/material/material_files.h"
#include "verbs.h"

namespace partwise::cli {
namespace {

struct FitOptions {
  std::string file, output;
};

void fit_material(const FitOptions& options, Run& run) {
  run.outputs.add_input("FILE", options.file);
  run.outputs.add("-o", options.output, {".json"});
  const HalfAngleTable measured = run.stage("read", [&] { return mean_over_phi(read_measured(options.file)); });
  const Dsbrdf fit = run.stage("fit", [&] { return fit_dsbrdf(measured); });
  const double error = run.stage("measure", [&] { return log_rmse(measured, fit); });
  const std::string name = std::filesystem::path(options.file).stem();
  run.stage("write", [&] { write_material(run.outputs.staged("-o"), {name, error, fit}); });
  run.report["log_rmse"] = error;
  run.report["name"] = name;
  run.report["coefficients"] = dsbrdf_size;
  run.report["input"] = options.file;
  const std::string written = run.report_files({{"o", options.output}});
  run.summary = fmt::format("{}: log-RMSE {:.3f}{}", options.file, error, written);
}

void list_materials(Run& run) {
  const std::vector<std::string> names = run.stage("list", [] { return shipped_materials(); });
  run.report["materials"] = names;
  run.summary = fmt::format("{}", fmt::join(names, "\n"));
}

// What threads, --json and the like mean is the verb's: they may stand behind the word as well as before it.
CLI::App& add_word(CLI::App& command, const char* word, const char* summary, bool& chosen) {
  CLI::App& added = *command.add_subcommand(word, summary);
  added.fallthrough();
  added.callback([&chosen] { chosen = true; });
  return added;
}

Action add(CLI::App& command) {
  struct Options {
    FitOptions fit;
    bool fitting = false, listing = false;
  };
  const auto options = std::make_shared<Options>();
  command.require_subcommand(1);
  CLI::App& fit = add_word(command, "fit", "Fit the model to a measured material", options->fitting);
  fit.add_option("FILE", options->fit.file, "A MERL table (.binary) or a Neural-BRDF network (.h5)")
      ->required()
      ->type_name("");
  add_file(fit, "-o", options->fit.output, "Write the fitted material (.json)")->required();
  add_word(command, "list", "Name the materials that ship", options->listing);
  return [options](Run& run) { options->fitting ? fit_material(options->fit, run) : list_materials(run); };
}

}  // namespace

const Verb material_verb = {
    "material", "Fit measured materials; list those that ship",
    "fit: the directional statistics model, 108 numbers, nearest to a measured material in the logarithm of the light "
    "that is sent on. list: the hundred materials of the MERL database, fitted.",
    "  partwise material fit gold-paint.binary -o gold-paint.json --json -\n  partwise material list", add};

}  // namespace partwise::cli
