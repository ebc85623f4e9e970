// Decomposes a mesh with an installed Partwise and looks at what it was given: consumer MESH
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/solid/decompose.h>

#include <algorithm>
#include <iostream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: consumer MESH\n";
    return 2;
  }
  const partwise::Mesh mesh = partwise::read_mesh(argv[1]);
  const partwise::Decomposition result = partwise::decompose(mesh, {.tolerance = 0.1});
  const bool labelled =
      std::ssize(result.labels) == mesh.faces.rows() &&
      std::ranges::all_of(result.labels, [&](int part) { return 0 <= part && part < result.parts(); });
  const bool hulled =
      std::ranges::all_of(result.hulls, [](const auto& hull) { return partwise::signed_volume(hull) > 0; });
  std::cout << result.parts() << " parts, concavity " << result.concavity << "\n";
  return labelled && hulled && result.parts() >= 2 && result.concavity <= 0.1 ? 0 : 1;
}
