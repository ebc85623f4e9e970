// Parts as people see them, a label a face: segment MESH OUT.seg
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/surface/segmentation.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::Segmentation found = partwise::segment(partwise::read_mesh(argv[1]));
  partwise::write_labels(argv[2], found.labels);
  std::cout << found.parts << " parts\n";
}
