// A preview scene as Embree sees it: what a ray hits, with position, normal and colour, and whether rays are blocked.
// Used by render_preview alone.
#pragma once

#include <embree3/rtcore.h>
#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

#include "partwise/appearance/corner_normals.h"
#include "partwise/appearance/preview.h"

namespace partwise {

struct PreviewHit {
  Eigen::Vector3f position;  // moved off the surface, towards the viewer: where further rays start
  Eigen::Vector3f normal;    // unit length, for shading, on the viewer's side
  Eigen::Vector3f colour;
};

class PreviewRays {
 public:
  explicit PreviewRays(const PreviewScene& scene);
  PreviewRays(const PreviewRays&) = delete;
  PreviewRays& operator=(const PreviewRays&) = delete;

  // False when nothing is hit. Direction of unit length.
  bool first_hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, PreviewHit& hit) const;
  bool blocked(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
  // Four directions from one origin; columns.
  std::array<bool, 4> blocked(const Eigen::Vector3f& origin, const Eigen::Matrix<float, 3, 4>& directions) const;

  Eigen::Vector3f centre() const { return (low_ + high_) / 2; }
  float size() const { return (high_ - low_).norm(); }  // diagonal of the bounding box
  float lowest() const { return low_.y(); }

 private:
  struct Surface {
    Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> vertices;
    CornerNormals corner_normals;
  };
  struct Body {                            // one Embree geometry, by its id
    std::vector<Eigen::Vector3f> colours;  // one a primitive, or one for all
    int surface = -1;                      // into surfaces_; -1 for tubes and spheres
  };

  void add(const PreviewMesh& mesh);
  void add_round(const Vertices& points, double radius, const Eigen::Vector3f& colour, bool joined);
  void add_body(RTCGeometry geometry, Body body);
  void smooth_hit(const Surface& surface, const RTCRayHit& ray, const Eigen::Vector3f& flat_normal,
                  PreviewHit& hit) const;

  struct Release {
    void operator()(RTCDeviceTy* device) const { rtcReleaseDevice(device); }
    void operator()(RTCSceneTy* scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<RTCDeviceTy, Release> device_;  // Freed also where the constructor throws.
  std::unique_ptr<RTCSceneTy, Release> scene_;
  std::vector<Body> bodies_;
  std::vector<Surface> surfaces_;
  std::vector<Faces> faces_;
  Eigen::Vector3f low_, high_;
};

}  // namespace partwise
