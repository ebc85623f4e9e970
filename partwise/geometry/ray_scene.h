// A mesh in Embree's bounding volume hierarchy, in single precision as it is given.
#pragma once

#include <embree3/rtcore.h>

#include "partwise/geometry/mesh.h"

namespace partwise {

class RayScene {
 public:
  RayScene(const Vertices& vertices, const Faces& faces, RTCSceneFlags flags);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  RTCScene scene() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

}  // namespace partwise
