// A mesh made half as tall again by its cage: cage MESH OUT.obj
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/applications/cage.h>
#include <partwise/parts/applications/cage_deformer.h>

#include <iostream>

int main(int, char** argv) {
  partwise::Mesh mesh = partwise::read_mesh(argv[1]);
  const partwise::Cage cage = partwise::make_cage(mesh);
  const partwise::CageDeformer deformer(mesh.vertices, cage.mesh);  // the slow part, once
  partwise::Vertices handles = cage.mesh.vertices;
  handles.col(1) *= 1.5;
  mesh.vertices = deformer.deformed(handles);
  partwise::write_mesh(argv[2], mesh);
  std::cout << "a cage of " << cage.mesh.faces.rows() << " faces\n";
}
