// The hulls of a mesh's parts as nets to print, cut out and glue: unfold MESH OUT.pdf
#include <partwise/base/atomic_file.h>
#include <partwise/geometry/mesh_io.h>
#include <partwise/parts/applications/net_sheets.h>
#include <partwise/parts/solid/decompose.h>

#include <iostream>
#include <vector>

int main(int, char** argv) {
  const partwise::Decomposition parts = partwise::decompose(partwise::read_mesh(argv[1]), {.tolerance = 0.1});
  std::vector<partwise::Unfolding> nets;
  for (const partwise::Mesh& hull : parts.hulls) nets.push_back(partwise::unfold(hull));
  const partwise::Sheets sheets = partwise::lay_out(nets);  // A4
  partwise::write_file(argv[2], partwise::as_pdf(sheets));
  std::cout << sheets.nets.size() << " nets on " << sheets.pages << " pages\n";
}
