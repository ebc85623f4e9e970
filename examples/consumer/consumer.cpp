// Decomposes a mesh with an installed Partwise, finds the medial axis between its parts, and looks at what it was
// given: consumer MESH
#include <partwise/geometry/mesh_io.h>
#include <partwise/motion/axis_samples.h>
#include <partwise/motion/margin_push.h>
#include <partwise/motion/world.h>
#include <partwise/parts/solid/decompose.h>

#include <algorithm>
#include <iostream>

namespace {

bool has_an_axis(const partwise::Mesh& mesh) {
  const partwise::World world = partwise::mesh_world(mesh);
  const partwise::MarginField field(world.scene->space(), world.contacts);
  const partwise::MarginPush push(*world.scene, field);
  const partwise::AxisSamples found = partwise::axis_samples(*world.scene, push, {.count = 50});
  return found.samples.size() == 50 && found.share_on_axis() == 1;
}

}  // namespace

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
  return labelled && hulled && result.parts() >= 2 && result.concavity <= 0.1 && has_an_axis(mesh) ? 0 : 1;
}
