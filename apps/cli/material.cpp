// partwise material: the fit of measured materials, pictures of balls in them, and those that ship.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "options.h"
#include "partwise/appearance/material/fit_dsbrdf.h"
#include "partwise/appearance/material/material_files.h"
#include "partwise/appearance/rendering/channel_files.h"
#include "partwise/appearance/rendering/material_ball.h"
#include "partwise/base/atomic_file.h"
#include "partwise/imaging/exr.h"
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

struct BallOptions {
  std::string material, output, light = "venice";
  int size = 256;
};

void draw_ball(const BallOptions& options, Run& run) {
  const bool from_file = is_material_file(options.material);
  if (from_file) run.outputs.add_input("NAME", options.material);
  if (is_light_file(options.light)) run.outputs.add_input("--light", options.light);
  run.outputs.add("-o", options.output, {".png", ".exr"});
  const std::shared_ptr<const Brdf> material = run.stage("read", [&] { return find_material(options.material); });
  const EnvironmentLight light = run.stage("read", [&] { return named_light(options.light); });
  const Image ball = run.stage("render", [&] { return material_ball(*material, LightTree(light), options.size); });
  run.stage("write", [&] {
    if (lower_ending(options.output) == ".exr") {
      write_exr(run.outputs.staged("-o"), ball);
    } else {
      write_file(run.outputs.staged("-o"), encode_tone_mapped(ball, grey_card_exposure(light)));
    }
  });
  run.report["name"] = from_file ? std::filesystem::path(options.material).stem().string() : options.material;
  run.report["light"] = options.light;
  run.report["width"] = run.report["height"] = options.size;
  const std::string written = run.report_files({{"o", options.output}});
  run.summary = fmt::format("{} under {}, {} x {} pixels{}", options.material, options.light, options.size,
                            options.size, written);
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
    BallOptions ball;
    bool fitting = false, drawing = false, listing = false;
  };
  const auto options = std::make_shared<Options>();
  command.require_subcommand(1);
  CLI::App& fit = add_word(command, "fit", "Fit the model to a measured material", options->fitting);
  fit.add_option("FILE", options->fit.file, "A MERL table (.binary) or a Neural-BRDF network (.h5)")
      ->required()
      ->type_name("");
  add_file(fit, "-o", options->fit.output, "Write the fitted material (.json)")->required();
  CLI::App& ball = add_word(command, "ball", "A picture of a ball in a material", options->drawing);
  ball.add_option("NAME", options->ball.material,
                  "A shipped material, or a file: fitted (.json), measured (.binary, .h5)")
      ->required()
      ->type_name("");
  add_file(ball, "-o", options->ball.output, "Write the picture: for the eye (.png) or in linear light (.exr)")
      ->required();
  add_file(ball, "--light", options->ball.light, "A shipped light by its name, or a file (.exr, .hdr)")
      ->type_name("LIGHT")
      ->default_str(options->ball.light);
  add_count(ball, "--size", options->ball.size, 1, "Pixels a side")->default_str(std::to_string(options->ball.size));
  add_word(command, "list", "Name the materials that ship", options->listing);
  return [options](Run& run) {
    if (options->fitting) return fit_material(options->fit, run);
    if (options->drawing) return draw_ball(options->ball, run);
    list_materials(run);
  };
}

}  // namespace

const Verb material_verb = {
    "material", "Fit measured materials, draw balls in them, list those that ship",
    "fit: the directional statistics model, 108 numbers, nearest to a measured material in the logarithm of the light "
    "that is sent on. ball: a picture under the light of a real place, exposed as by a grey card, on clear ground. "
    "list: the hundred materials of the MERL database, fitted.",
    "  partwise material fit gold-paint.binary -o gold-paint.json --json -\n"
    "  partwise material ball chrome -o chrome.png\n  partwise material list",
    add};

}  // namespace partwise::cli
