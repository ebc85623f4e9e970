// Decompositions and skeletons as SVG drawings and as GeoJSON.
#pragma once

#include <filesystem>

#include "partwise/parts/planar/skeleton.h"

namespace partwise {

struct PictureSettings {
  bool y_down = false;  // the coordinates are a picture's already; else y is turned so that up is up
  double size = 800;    // longer side, pixels
};

// Parts in soft colours, neighbours told apart; cuts as dark lines, the outline and noise holes thin. Atomic, and so
// are the others.
void write_outline_svg(const std::filesystem::path& path, const Outline& outline, const PictureSettings& settings = {});

// The shape pale, the skeleton over it.
void write_skeleton_svg(const std::filesystem::path& path, std::span<const Polygon> shape, const Skeleton& skeleton,
                        const PictureSettings& settings = {});

// Points with their kind ("part", "cut" or "tip"), then lines with the numbers of their nodes.
void write_skeleton_geojson(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace partwise
