// Models that the reader turns: a still picture, and for browsers with WebGL the model itself as GLB, which viewer.js
// puts in its place, seen by the same camera.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "html.h"
#include "partwise/appearance/preview.h"
#include "partwise/geometry/mesh_io.h"

namespace demo {

// What the slider below a model does, by the names of its members.
enum class Slider {
  apart,    // moves "part N" and "hull N" away from the middle; a switch shows one or the other
  between,  // leads from "NAME from" to "NAME to", which have the same faces; a member named "cage" is drawn as lines
  along,    // shows one of "robot 0", "robot 1", ... instead of all
};

struct Turnable {
  Picture still;
  std::string glb, camera;  // camera: its position and what it turns about, six numbers
  Slider slider{};
  std::string_view label;
  double start = 0;  // of the slider, 0 to 1: as the still picture has it
};

struct Turning {
  Slider slider{};
  std::string_view label;
  double start = 0;
  double azimuth = 35, elevation = 20;  // degrees, to begin with
  int width = 720, height = 560;
};

// The camera keeps its distance when the model is turned about its vertical axis; from there the still picture's
// meshes and all of `meshes` are in view.
Turnable make_turnable(const partwise::PreviewScene& still, std::span<const partwise::NamedMesh> meshes,
                       const Turning& turning, std::string caption, std::string description);

std::string figure(const Turnable& model, std::string_view id);

// What the figures need, to be written once, after the last of them.
std::string viewer_scripts();

}  // namespace demo
