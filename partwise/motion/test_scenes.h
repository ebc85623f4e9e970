// Small scenes whose medial axes are known.
#pragma once

#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"

namespace partwise {

inline Polygons rectangle(double x0, double y0, double x1, double y1) {
  Ring ring(4, 2);
  ring << x0, y0, x1, y0, x1, y1, x0, y1;
  return {{ring, {}}};
}

inline Mesh box_mesh(const Point& low, const Point& high) {
  Mesh mesh;
  mesh.vertices.resize(8, 3);
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) mesh.vertices(i, k) = (i >> k & 1) != 0 ? high[k] : low[k];
  }
  mesh.faces.resize(12, 3);
  mesh.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7,
      5;
  return mesh;
}

}  // namespace partwise
