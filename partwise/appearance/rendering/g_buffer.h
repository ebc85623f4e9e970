// What a camera sees of meshes, by rays: normals, depths and parts, several samples a pixel (Embree).
//
// Samples lie in a Hammersley set that is the same for every pixel; of one, in the middle. Normals are in camera space
// (+x right, +y up, +z towards the camera), of unit length, on the side of the surface that is seen; where they come
// from the corners of a face they may lean away from the viewer at a silhouette. Nothing seen: normal zero, depth 0,
// part -1. Depth is along the viewing direction, in model units, from the camera's position. Row 0 is the top. The same
// bytes for any number of threads. Errors: CheckFailed for settings out of range and lists of unequal length.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

#include "partwise/appearance/camera.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/geometry/mesh.h"
#include "partwise/imaging/image.h"

namespace partwise {

struct RenderMesh {
  Mesh mesh;
  std::vector<int> parts{};    // one a face, 0 or more; empty: all faces are part 0
  double crease_degrees = 40;  // 0: every face is flat; 180: all edges are smooth
};

struct RasterSize {
  int width = 256, height = 256;  // pixels
  int samples = 4;                // a pixel
};

struct GBuffer {
  RasterSize size;
  // Pixel by pixel from the top left, the samples of a pixel together.
  std::vector<Eigen::Vector3f> normals;
  std::vector<float> depths;
  std::vector<int> parts;

  // Of pixels: means over the samples that see something. The mask is the share that does.
  Image normal_image() const;               // 3 channels, unit length or zero
  Image depth_image() const;                // 1 channel
  Image mask_image() const;                 // 1 channel
  std::vector<int> part_of_pixels() const;  // that of most samples, the lowest of several; -1 where most see nothing
  double foreground() const;                // share of the samples that see something
};

// Where a sample that sees something sees it, in model space.
Eigen::Vector3d seen_point(const GBuffer& seen, const Camera& camera, std::size_t sample);

// Meshes as rays see them; built once, for any number of views.
class RenderScene {
 public:
  explicit RenderScene(std::span<const RenderMesh> meshes);
  ~RenderScene();
  RenderScene(RenderScene&&) noexcept;
  RenderScene& operator=(RenderScene&&) noexcept;

  int parts() const;  // one more than the largest
  const Vertices& vertices() const;

  GBuffer view(const Camera& camera, const RasterSize& size) const;

  // Of each light sample (directions in camera space) 1 where it reaches the point that `sample` of the G-buffer sees
  // and 0 where a mesh is in the way; light from below the surface is not asked for.
  void lit(const Camera& camera, const GBuffer& seen, std::size_t sample, const LightSamples& light,
           Eigen::ArrayXf& visible) const;

 private:
  struct Rays;
  std::unique_ptr<Rays> rays_;
};

struct ShareView {
  double azimuth = 35, elevation = 20;  // degrees, as in CameraView
  double field_of_view = 0;             // 0: orthographic
  double share = 0.45;                  // of the frame that the meshes should cover
};

// The camera for which the meshes cover `share` of the frame, or less where all of them would not be in view: they take
// at most 0.96 of its width and height.
Camera frame_share(const RenderScene& scene, const ShareView& view, double width_over_height);

}  // namespace partwise
