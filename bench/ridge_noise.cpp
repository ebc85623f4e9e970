// Do convex ridges stay put under noise? Liu 2017, section 2.4.3.1 and Figure 2.27.
//
//   ridge_noise MESH [--tolerance T] [--amplitudes A...] [--seeds N] [--along-normals]
//
// Finds the ridges of each connected component of the whole mesh, and again of noisy copies in which every vertex was
// moved by a vector drawn evenly from the ball of radius A (or by a length drawn evenly from [-A, A] along its normal).
// The mesh is scaled to R = 1 before that, and never after: the tolerance is the same length for all copies. Prints one
// JSON object. For each copy: its ridges, how many of the mesh's `stay` (see ridges/ridge_match.h: at most the
// tolerance away from a ridge of the copy, one to one), how many ridges of the copy are `extra`, and of those that do
// not stay how many `grew` (a ridge of the copy holds them to within the tolerance: two have become one, or one reaches
// farther), `shrank` (they hold a ridge of the copy to within the tolerance: one has become two, or an end is lost), or
// are `gone`.
//
// `compact` ridges, of a diameter of at most half R, are counted apart (`stay_compact`): those are tips, where the
// others reach from one tip over the hull to the next, as far as the order of the bridges happens to take them.
//
// `other_tolerance`: the same for the mesh without noise at 0.9 and at 1.1 times the tolerance. A ridge that does not
// stay there hangs on a valley near the tolerance, which little noise turns as well.
//
// Exits 0, 1 when it cannot be done, 2 for wrong usage.
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bench/ridges/ridge_match.h"
#include "bench/tool.h"
#include "bench/variants/variants.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/convex_ridges.h"
#include "partwise/parts/solid/valley_decomposition.h"

namespace {

using nlohmann::ordered_json;
using partwise::Mesh;
using partwise::bench::noisy;
using partwise::bench::Ridge;

constexpr double kCompact = 0.5;  // diameter, R

struct Ridges {
  std::vector<Ridge> ridges;
  std::vector<char> compact;
  int hull_vertices = 0, shallow = 0, deep = 0, rims = 0;
};

bool is_compact(const Ridge& ridge) {
  for (std::size_t i = 0; i < ridge.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((ridge[i] - ridge[j]).norm() > kCompact) return false;
  return true;
}

// Without a deep valley (rims, which run on the hull, do not count) a component is one ridge.
Ridges find_ridges(const Mesh& mesh, double tolerance) {
  const partwise::SurfaceQuery surface(partwise::orient_consistently(mesh));
  std::vector<int> faces(static_cast<std::size_t>(mesh.faces.rows()));
  std::iota(faces.begin(), faces.end(), 0);
  Ridges found;
  for (const std::vector<int>& group : partwise::connected_groups(mesh, faces)) {
    const partwise::PartGraph part = partwise::part_graph(mesh, group);
    const partwise::Bridges bridges = find_bridges(part, part_hull(part, tolerance), surface, tolerance);
    found.shallow += static_cast<int>(bridges.shallow.size());
    found.deep += static_cast<int>(bridges.deep.size());
    found.rims += static_cast<int>(bridges.rims.size());
    bool first = true;
    for (const std::vector<int>& members : partwise::convex_ridges(part, bridges).members) {
      if (first || !bridges.deep.empty()) found.ridges.emplace_back();
      first = false;
      for (const int v : members) found.ridges.back().push_back(part.positions.row(v));
      found.hull_vertices += static_cast<int>(members.size());
    }
  }
  for (const Ridge& ridge : found.ridges) found.compact.push_back(is_compact(ridge));
  return found;
}

ordered_json described(const Ridges& found) {
  return {{"ridges", found.ridges.size()},
          {"compact", std::count(found.compact.begin(), found.compact.end(), 1)},
          {"hull_vertices", found.hull_vertices},
          {"shallow", found.shallow},
          {"deep", found.deep},
          {"rims", found.rims}};
}

ordered_json compared(const Ridges& clean, const Ridges& noisy, double tolerance) {
  const auto match = partwise::bench::match_ridges(clean.ridges, noisy.ridges, tolerance);
  int stay_compact = 0, grew = 0, shrank = 0, gone = 0;
  for (std::size_t i = 0; i < clean.ridges.size(); ++i) {
    if (match.partner[i] >= 0) {
      stay_compact += clean.compact[i];
      continue;
    }
    bool inside = false, around = false;
    for (const Ridge& other : noisy.ridges) {
      inside |= partwise::bench::reach_out(clean.ridges[i], other) <= tolerance;
      around |= partwise::bench::reach_out(other, clean.ridges[i]) <= tolerance;
    }
    ++(inside ? grew : around ? shrank : gone);
  }
  ordered_json result = described(noisy);
  result["stay"] = match.matched;
  result["stay_compact"] = stay_compact;
  result["extra"] = static_cast<int>(noisy.ridges.size()) - match.matched;
  result["grew"] = grew;
  result["shrank"] = shrank;
  result["gone"] = gone;
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  std::string path;
  double tolerance = 0.08;
  std::vector<double> amplitudes{0.005, 0.01, 0.02};
  int seeds = 3, threads = 1;
  bool along_normals = false;
  CLI::App app("Do convex ridges stay put under noise?");
  app.add_option("mesh", path, "any mesh that the library reads")->required();
  app.add_option("--tolerance", tolerance, "share of the bounding-sphere radius")->check(CLI::PositiveNumber);
  app.add_option("--amplitudes", amplitudes, "of the noise, shares of the radius")->check(CLI::NonNegativeNumber);
  app.add_option("--seeds", seeds, "noisy copies an amplitude")->check(CLI::PositiveNumber);
  app.add_flag("--along-normals", along_normals, "move vertices along their normals only");
  app.add_option("--threads", threads)->check(CLI::PositiveNumber);
  return partwise::bench::run_tool("ridge_noise", app, argc, argv, [&] {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    Mesh mesh = partwise::read_mesh(path);
    const partwise::Sphere sphere = partwise::bounding_sphere(mesh);
    mesh.vertices = ((mesh.vertices.rowwise() - sphere.centre) / sphere.radius).eval();
    const Ridges clean = find_ridges(mesh, tolerance);
    ordered_json others = ordered_json::array(), runs = ordered_json::array();
    for (const double factor : {0.9, 1.1}) {
      ordered_json run{{"factor", factor}};
      run.update(compared(clean, find_ridges(mesh, factor * tolerance), tolerance));
      others.push_back(std::move(run));
    }
    for (const double amplitude : amplitudes)
      for (int seed = 1; seed <= seeds; ++seed) {
        ordered_json run{{"amplitude", amplitude}, {"seed", seed}};
        run.update(compared(clean, find_ridges(noisy(mesh, amplitude, seed, along_normals), tolerance), tolerance));
        runs.push_back(std::move(run));
      }
    ordered_json report{{"mesh", path}, {"tolerance", tolerance}, {"radius", sphere.radius}};
    report.update(described(clean));
    report["other_tolerance"] = std::move(others);
    report["noisy"] = std::move(runs);
    std::cout << report.dump() << '\n';
    return 0;
  });
}
