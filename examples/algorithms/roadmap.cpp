// Samples of the medial axis between the parts of a mesh, and edges along it: roadmap MESH
#include <partwise/geometry/mesh_io.h>
#include <partwise/motion/margin_push.h>
#include <partwise/motion/roadmap.h>
#include <partwise/motion/world.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::World world = partwise::mesh_world(partwise::read_mesh(argv[1]));
  const auto push = partwise::trained_push(*world.scene, world.contacts);  // the max-margin field
  const partwise::AxisSamples found = partwise::axis_samples(*world.scene, *push, {.count = 200});
  const partwise::Roadmap roadmap = partwise::connected(*world.scene, found.samples, *push);
  std::cout << found.samples.size() << " samples, " << roadmap.edges.size() << " edges\n";
}
