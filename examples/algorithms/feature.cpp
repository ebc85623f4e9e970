// Where a mesh is wide and where it is narrow, by what its vertices see of each other: feature MESH
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/surface/continuous_visibility.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::Mesh mesh = partwise::read_mesh(argv[1]);
  const Eigen::VectorXd values =
      partwise::continuous_visibility(mesh, {.kind = partwise::VisibilityKind::avg}).values;  // an area a vertex
  Eigen::Index widest = 0, narrowest = 0;
  values.maxCoeff(&widest);
  values.minCoeff(&narrowest);
  std::cout << "widest at " << mesh.vertices.row(widest) << ", narrowest at " << mesh.vertices.row(narrowest) << "\n";
}
