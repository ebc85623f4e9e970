// Roadmaps for people: a drawing of the plane, a scene of space to be turned. What the program and the demo share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/geometry/mesh.h"
#include "partwise/geometry/polygon.h"
#include "partwise/motion/motion_path.h"
#include "partwise/motion/roadmap.h"

namespace partwise {

// Obstacles grey, edges from dark blue where they are close to obstacles to yellow where there is room; ways among them
// red and orange, in turn.
std::string roadmap_svg(const std::vector<Polygons>& obstacles, const std::vector<AxisSample>& samples,
                        const Roadmap& roadmap, const std::vector<MotionPath>& ways = {});

// A prism of three sides around each segment of a line.
Mesh tube_along(const std::vector<Eigen::Vector3d>& line, double radius);

// The obstacles, and the edges as thin tubes in the same colours.
void write_roadmap_glb(const std::filesystem::path& path, const std::vector<Mesh>& obstacles,
                       const std::vector<AxisSample>& samples, const Roadmap& roadmap);

}  // namespace partwise
