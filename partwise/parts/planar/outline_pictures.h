// Decompositions and skeletons as SVG drawings and as GeoJSON.
#pragma once

#include <filesystem>
#include <string>

#include "partwise/parts/planar/skeleton.h"

namespace partwise {

struct PictureSettings {
  bool y_down = false;  // the coordinates are a picture's already; else y is turned so that up is up
  double size = 800;    // longer side, pixels
  bool ground = true;   // white; else what is behind shows through
};

// Parts in soft colours, neighbours told apart; cuts as red lines, the outline and noise holes thin. What is written is
// atomic, and so are the others.
std::string outline_svg(const Outline& outline, const PictureSettings& settings = {});
void write_outline_svg(const std::filesystem::path& path, const Outline& outline, const PictureSettings& settings = {});

// The shape pale, the skeleton over it.
std::string skeleton_svg(std::span<const Polygon> shape, const Skeleton& skeleton,
                         const PictureSettings& settings = {});
void write_skeleton_svg(const std::filesystem::path& path, std::span<const Polygon> shape, const Skeleton& skeleton,
                        const PictureSettings& settings = {});

// Points with their kind ("part", "cut" or "tip"), then lines with the numbers of their nodes.
void write_skeleton_geojson(const std::filesystem::path& path, const Skeleton& skeleton);

}  // namespace partwise
