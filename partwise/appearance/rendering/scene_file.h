// A scene to be rendered, from JSON (docs/render.md), and its image.
//
// Files are named relative to the scene's folder, or another that is given. Every field is checked, and none may be
// there that is not known. Errors: InputError with the scene's file and the field's place ("meshes[1].labels") for what
// is missing, of the wrong kind or out of range, and those of the files that it names.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "partwise/appearance/material/brdf.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/appearance/rendering/part_colours.h"
#include "partwise/imaging/image.h"

namespace partwise {

struct SceneFile {
  std::vector<RenderMesh> meshes;                      // parts are numbered on from mesh to mesh
  std::vector<std::shared_ptr<const Brdf>> materials;  // one a part
  EnvironmentLight light = EnvironmentLight(Image(2, 1, 3));
  bool light_turns_with_camera = true;
  ShareView view;
  RasterSize size;
  RenderPath path = RenderPath::reflectance_map;
  int map_size = 64;
  bool shadows = false;                      // exact alone
  std::vector<std::filesystem::path> files;  // all that were read
};

SceneFile read_scene(const std::filesystem::path& path);
SceneFile read_scene(const std::filesystem::path& path, const std::filesystem::path& folder);

struct RenderedScene {
  GBuffer seen;
  Camera camera;
  Image image;  // linear RGB
};

RenderedScene render(const SceneFile& scene);

}  // namespace partwise
