// From a mesh to a body that Bullet can simulate: decompose, make a compound of the hulls, drop it, report.
//
//   bullet_compound MESH [TOLERANCE]

#include <fmt/format.h>

#include <cstdlib>
#include <exception>

#include "drop.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/solid/decompose.h"

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    fmt::print(stderr, "usage: bullet_compound MESH [TOLERANCE]\n");
    return 2;
  }
  try {
    partwise::DecompositionSettings settings;
    if (argc == 3) settings.tolerance = std::atof(argv[2]);
    const partwise::Decomposition parts = partwise::decompose(partwise::read_mesh(argv[1]), settings);
    const Compound compound = make_compound(parts.hulls, 1 / parts.radius);  // a bounding sphere of 1 m
    const Drop result = drop(compound, parts.hulls);
    fmt::print("{} hulls, {:.1f} kg, ", parts.parts(), compound.mass);
    if (!result.rested) {
      fmt::print("still moving after {:.1f} s\n", result.seconds);
      return 1;
    }
    fmt::print("at rest after {:.2f} s, lowest point {:+.2f} mm from the floor\n", result.seconds,
               1000 * result.lowest);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bullet_compound: {}\n", error.what());
    return 1;
  }
}
