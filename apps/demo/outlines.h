// What the page shows of shapes in the plane: clean outlines and their skeletons, one with a noisy scan of it, and a
// herd of the shipped models on one line, as crowded and as full of holes as a photograph would give it.
#pragma once

#include <span>
#include <vector>

#include "page.h"
#include "partwise/geometry/mesh.h"

namespace demo {

// `herd`: the meshes to choose from.
OutlineStory tell_outlines(std::span<const partwise::Mesh* const> herd);

}  // namespace demo
