// Triangles of one polygon in space.
//
// The polygon is projected along its Newell normal (the vector area: Sutherland, Sproull, Schumacker 1974). Convex
// polygons become a fan about their first corner; others are clipped ear by ear (Meisters 1975), first ear first.
// Always n - 2 triangles with the polygon's orientation: where no ear exists because the polygon crosses itself or is
// flat, a corner is cut all the same. Time O(n) if convex, else O(n r) with r reflex corners.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "partwise/geometry/mesh.h"

namespace partwise {

// Appends n - 2 triangles with vertex indices taken from `polygon` (n >= 3 indices into `vertices`).
void triangulate_polygon(const Vertices& vertices, std::span<const int> polygon,
                         std::vector<std::array<int, 3>>& triangles);

}  // namespace partwise
