// What --png writes: one picture for people, on a clear background, of what a verb found.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/appearance/preview.h"
#include "partwise/geometry/mesh.h"

namespace partwise::cli {

// All of it from the front, a little from the right and from above. A mesh stands on its shadow; without points the
// picture is empty.
void write_picture(const std::filesystem::path& path, PreviewMesh mesh);
void write_picture(const std::filesystem::path& path, std::vector<PreviewPoints> points);

// The mesh inside the edges of its cage.
void write_cage_picture(const std::filesystem::path& path, const Mesh& mesh, const Mesh& cage);

}  // namespace partwise::cli
