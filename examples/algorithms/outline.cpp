// Cuts a shape in the plane into nearly convex parts and draws them: outline SHAPE OUT.svg
#include <partwise/parts/planar/outline.h>
#include <partwise/parts/planar/outline_pictures.h>
#include <partwise/parts/planar/read_shape.h>

#include <iostream>

int main(int, char** argv) {
  const partwise::PolygonFile file = partwise::read_shape(argv[1]);  // .png, .svg, .geojson, .wkt, .poly
  const partwise::Outline outline = partwise::decompose_outline(file.polygons, {.tolerance = 0.05});
  partwise::write_outline_svg(argv[2], outline);
  std::cout << outline.parts.size() << " parts, concavity " << outline.concavity << " of R\n";
}
