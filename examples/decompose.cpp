// Cuts a mesh into nearly convex parts and writes their hulls: decompose INPUT OUTPUT.obj
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/solid/decompose.h>

#include <iostream>

int main(int, char** argv) {
  // [README]
  const partwise::Mesh mesh = partwise::read_mesh(argv[1]);
  const partwise::Decomposition result = partwise::decompose(mesh, {.tolerance = 0.05});

  std::vector<partwise::NamedMesh> hulls;
  for (const partwise::Mesh& hull : result.hulls) hulls.push_back({.name = "part", .mesh = hull});
  partwise::write_meshes(argv[2], hulls);
  std::cout << result.parts() << " parts, concavity " << result.concavity << " of R\n";
  // [README]
}
