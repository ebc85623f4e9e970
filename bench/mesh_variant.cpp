// A mesh changed in a stated way, as an OFF file of triangles.
//
//   mesh_variant MESH OUT.off [--noise A --seed S] [--vertices N] [--smooth N]
//
// --noise moves every vertex by a vector drawn evenly from the ball of radius A, a share of the bounding-sphere radius
// R. --vertices halves edges until there are about N vertices and adds slight waves (variants/variants.h). --smooth
// takes noise away again (geometry/smoothing.h), last. With none of them the mesh is as the library reads it. Exits 0,
// 1 when it cannot be done, 2 for wrong usage.
#include <CLI/CLI.hpp>
#include <iostream>

#include "bench/tool.h"
#include "bench/variants/variants.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/geometry/smoothing.h"

int main(int argc, char** argv) {
  std::string path, out;
  double noise = 0;
  int seed = 1, vertices = 0, smooth = 0;
  CLI::App app("A mesh changed in a stated way");
  app.add_option("mesh", path, "any mesh that the library reads")->required();
  app.add_option("out", out, "OFF file")->required();
  app.add_option("--noise", noise, "share of the bounding-sphere radius")->check(CLI::NonNegativeNumber);
  app.add_option("--seed", seed, "of the noise");
  app.add_option("--vertices", vertices, "about so many")->check(CLI::PositiveNumber);
  app.add_option("--smooth", smooth, "rounds")->check(CLI::NonNegativeNumber);
  return partwise::bench::run_tool("mesh_variant", app, argc, argv, [&] {
    partwise::Mesh mesh = partwise::read_mesh(path);
    if (vertices > 0) mesh = partwise::bench::rippled(partwise::bench::finer(mesh, vertices));
    if (noise > 0)
      mesh =
          partwise::bench::noisy(mesh, noise * partwise::bounding_sphere(mesh).radius, seed, /*along_normals=*/false);
    if (smooth > 0) mesh = partwise::smoothed(mesh, smooth);
    partwise::write_mesh(out, mesh);
    return 0;
  });
}
