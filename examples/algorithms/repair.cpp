// A watertight mesh around one with holes: repair MESH OUT.obj
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/applications/repair.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::Repair repaired = partwise::repair(partwise::read_mesh(argv[1]), {.tolerance = 0.1});
  partwise::write_mesh(argv[2], repaired.mesh);
  std::cout << "volume " << partwise::signed_volume(repaired.mesh) << ", nowhere farther than " << repaired.reach
            << " of R from what was given\n";
}
