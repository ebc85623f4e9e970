#include "beside.h"

#include <fmt/format.h>

#include <initializer_list>
#include <set>
#include <utility>

#include "history.h"
#include "html.h"

namespace demo {
namespace {

using nlohmann::json;

json decomposition_run(std::string_view measure) {
  return newest_run("decompose", [&](const json& run) {
    if (!run.contains("totals")) return false;
    const json& settings = run["settings"];
    return run["meshes"] == 190 && settings["measure"] == measure && settings["tolerance"] == 0.1 &&
           settings["max_hull_vertices"] == 0;
  });
}

std::string note(std::string_view text) { return fmt::format("<p class=\"note\">{}</p>\n", text); }

// "2026-11-24", or "2026-11-24 to 2026-11-26".
std::string dates_of(std::initializer_list<const json*> runs) {
  std::set<std::string> dates;
  for (const json* run : runs) dates.insert(date_of(*run));
  return dates.size() == 1 ? *dates.begin() : *dates.begin() + " to " + *dates.rbegin();
}

double seconds_of(const json& run) {
  double sum = 0;
  for (const char* stage : {"parts", "train", "sample", "connect"}) sum += run["seconds"].value(stage, 0.0);
  return sum;
}

}  // namespace

std::string parts_beside() {
  std::vector<Row> rows = {{"dissertation, HACD", "9.21", "1.29", "850"},
                           {"dissertation, WCSEg", "9.42", "1.38", "1087"},
                           {"dissertation, CoRiSE", "8.00", "1.36", "1.75"}};
  const json valley = decomposition_run("valley"), hull = decomposition_run("hull");
  for (const auto& [measure, run] : {std::pair{"valley", &valley}, std::pair{"hull", &hull}}) {
    const json& totals = run->at("totals");
    rows.push_back({fmt::format("ours, <b>{}</b>", measure), fmt::format("{:.2f}", totals["parts"].get<double>()),
                    fmt::format("{:.2f}", totals["volume_ratio"].get<double>()),
                    fmt::format("{:.2f}", totals["cpu_seconds"].get<double>())});
  }
  return "<h3>Beside the dissertation&rsquo;s Table 2.3</h3>\n" +
         table({"tolerance 0.1", "parts", "volume ratio", "seconds a mesh"}, rows) +
         note(fmt::format(
             "Means over the Princeton benchmark: the dissertation&rsquo;s over 380 meshes on its machine, ours "
             "over 190 of them in processor seconds, as recorded in bench/history/decompose.jsonl ({}).",
             dates_of({&valley, &hull})));
}

std::string segments_beside() {
  const auto run = [](std::string_view mode, std::string_view labels) {
    return newest_run("segmentation",
                      [&](const json& each) { return each["mode"] == mode && each.value("labels", "") == labels; });
  };
  const json sdf = run("labels", "sdf"), averaged = run("labels", "cvf-avg"), strong = run("labels", "cvf-strong"),
             learnt = run("labels", "learnt"), people = run("people", "");
  const auto row = [](std::string name, std::string published, const json& ours) {
    return Row{std::move(name), std::move(published), fmt::format("{:.3f}", ours["rand_error"].get<double>()),
               std::to_string(ours["meshes"].get<int>())};
  };
  return "<h3>Beside the dissertation&rsquo;s Table 2.1</h3>\n" +
         table({"Rand error", "dissertation", "ours", "meshes"}, {row("SDF", "0.18", sdf),
                                                                  {"CVF", "0.17", "", ""},
                                                                  row("CVF averaged", "0.15", averaged),
                                                                  row("CVF strong", "", strong),
                                                                  row("learnt borders", "", learnt),
                                                                  row("a person", "", people)}) +
         note(fmt::format("Mean over meshes of the Princeton benchmark, against its people. Ours as recorded in "
                          "bench/history/segmentation.jsonl ({}); learnt borders are what one gets without options, a "
                          "person is one against the others.",
                          dates_of({&sdf, &averaged, &strong, &learnt, &people})));
}

std::string motion_beside() {
  const json run = newest_run("motion", [](const json& each) { return each["kind"] == "methods"; });
  const auto seconds = [&](const char* scene, const char* method) {
    return fmt::format("{:.1f}", seconds_of(run["found"][scene][method]));
  };
  return "<h3>Beside the dissertation&rsquo;s Table 5.1</h3>\n" +
         table({"seconds", "town", "frame"},
               {{"dissertation, MAPRM", "715", "1337"},
                {"dissertation, SVMA", "542", "323"},
                {"ours, MAPRM, rays", seconds("city", "maprm"), seconds("frame", "maprm")},
                {"ours, <b>max-margin fields</b>", seconds("city", "svma"), seconds("frame", "svma")}}) +
         note(fmt::format(
             "354 obstacles in the plane and 40&#8239;000 samples, 148 in space and 20&#8239;000, edges included. The "
             "dissertation&rsquo;s town is another one, on its machine; ours on two cores, as recorded in "
             "bench/history/motion.jsonl ({}).",
             date_of(run)));
}

}  // namespace demo
