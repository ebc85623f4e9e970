#include "partwise/geometry/ray_scene.h"

#include <cstddef>

namespace partwise {

RayScene::RayScene(const Vertices& vertices, const Faces& faces, RTCSceneFlags flags)
    : device_(rtcNewDevice("threads=1")),  // One thread builds the hierarchy, so that it is the same one each time.
      scene_(rtcNewScene(device_)) {
  rtcSetSceneFlags(scene_, flags);
  RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex =
      static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                  3 * sizeof(float), static_cast<std::size_t>(vertices.rows())));
  for (Eigen::Index i = 0; i < vertices.size(); ++i) vertex[i] = static_cast<float>(vertices.data()[i]);
  auto* index =
      static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                     3 * sizeof(unsigned), static_cast<std::size_t>(faces.rows())));
  for (Eigen::Index i = 0; i < faces.size(); ++i) index[i] = static_cast<unsigned>(faces.data()[i]);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene_, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene_);
}

RayScene::~RayScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

}  // namespace partwise
