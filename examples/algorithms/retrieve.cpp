// The parts of other meshes that are most like one part of a mesh: retrieve QUERY PART OTHER...
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/surface/part_retrieval.h>

#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  const partwise::PartIndex query = partwise::index_parts(partwise::read_mesh(argv[1]));
  std::vector<partwise::PartIndex> others;
  for (int i = 3; i < argc; ++i) others.push_back(partwise::index_parts(partwise::read_mesh(argv[i])));
  std::vector<const partwise::PartIndex*> searched;
  for (const partwise::PartIndex& each : others) searched.push_back(&each);
  for (const partwise::PartMatch& match : partwise::similar_parts(query, std::stoi(argv[2]), searched, 5))
    std::cout << argv[3 + match.mesh] << " part " << match.part << ": " << match.similarity << "\n";
}
