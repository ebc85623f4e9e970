// What --png writes: one picture for people, on a clear background, of what a verb found.
#pragma once

#include <filesystem>
#include <vector>

#include "partwise/appearance/preview.h"

namespace partwise::cli {

// All of it from the front, a little from the right and from above. A mesh stands on its shadow; without points the
// picture is empty.
void write_picture(const std::filesystem::path& path, PreviewMesh mesh);
void write_picture(const std::filesystem::path& path, std::vector<PreviewPoints> points);

}  // namespace partwise::cli
