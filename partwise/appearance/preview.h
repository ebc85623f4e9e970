// Pictures of meshes for people: a small ray caster (Embree) with a soft sky, one key light, and a shadow on the
// ground.
//
// Light. Sky and ground bounce are gathered with cosine-weighted rays, the key light is a disk of a few degrees.
// Samples are interleaved: the subpixels of each 4 x 4 block use 16 different parts of one low-discrepancy set, and a
// filter that does not cross edges joins them again (Keller and Heidrich 2001), so pictures are free of noise with few
// rays. Surfaces are matt and seen from both sides. Shading normals are smooth across edges below the crease angle.
//
// Output: linear RGB with straight alpha (4 channels). Where nothing is seen alpha is 0; the ground's shadow is black
// with an alpha meant for compositing sRGB values, as browsers do. So a picture fits on light and dark pages.
// Conventions: right-handed, y up, the camera looks along its -z; lengths in model units, angles in degrees, colours
// linear RGB in [0, 1]. The same bytes for any number of threads.
// Errors: CheckFailed for a scene without any vertex, for settings out of range, and for lists of unequal length.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "partwise/appearance/camera.h"
#include "partwise/geometry/mesh.h"
#include "partwise/imaging/image.h"

namespace partwise {

struct PreviewMesh {
  Mesh mesh;
  std::vector<Eigen::Vector3f> face_colours;                      // one a face, or none: then all faces have `colour`
  Eigen::Vector3f colour = Eigen::Vector3f(0.58f, 0.56f, 0.53f);  // albedo
  double crease_degrees = 40;                                     // 0: every face is flat
};

struct PreviewCurve {  // a polyline, drawn as a tube with round joints
  Vertices points;     // at least 2
  double radius = 0;
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();
};

struct PreviewPoints {  // drawn as spheres
  Vertices points;
  double radius = 0;
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();
};

struct PreviewScene {
  std::vector<PreviewMesh> meshes;
  std::vector<PreviewCurve> curves;
  std::vector<PreviewPoints> points;
  bool ground = true;  // the plane below the lowest vertex of the meshes takes a shadow
};

using PreviewCamera = Camera;
using PreviewView = CameraView;

// The nearest camera in the given direction that sees the whole scene, which touches the frame on opposite sides.
PreviewCamera frame_scene(const PreviewScene& scene, const PreviewView& view, double width_over_height);

struct PreviewSettings {
  int width = 480, height = 400;  // pixels
  int subpixels = 2;              // along each side of a pixel, 1 or more
};

Image render_preview(const PreviewScene& scene, const PreviewCamera& camera, const PreviewSettings& settings = {});

}  // namespace partwise
