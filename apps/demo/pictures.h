// The pictures of one model: as it came, its deep valleys and convex ridges at the tolerance, its parts, and their
// hulls drawn apart.
#pragma once

#include "partwise/appearance/preview.h"
#include "partwise/parts/solid/decompose.h"

namespace demo {

struct ModelPictures {
  partwise::Image input, ridges, parts, hulls;
  int ridge_count = 0;   // convex ridges of all connected pieces of the input together
  int valley_count = 0;  // deep valleys between them
};

// The middle of the box about them.
partwise::Point middle(const partwise::Vertices& points);

// The scene from `azimuth` degrees, framed.
partwise::Image draw(const partwise::PreviewScene& scene, double azimuth,
                     const partwise::PreviewSettings& settings = {});

ModelPictures draw_model(const partwise::Mesh& mesh, const partwise::Decomposition& parts, double azimuth);

// The hulls of a decomposition as preview meshes in the colours of the parts; each is moved away from their common
// centre by `apart` times its distance.
std::vector<partwise::PreviewMesh> hull_meshes(const partwise::Decomposition& parts, double apart);

}  // namespace demo
