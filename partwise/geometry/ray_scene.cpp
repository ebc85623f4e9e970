#include "partwise/geometry/ray_scene.h"

#include <tbb/task_arena.h>

#include <cstddef>

namespace partwise {

RayScene::RayScene(const Vertices& vertices, const Faces& faces, RTCSceneFlags flags)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
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
  // One thread builds the hierarchy, so that it is the same one each time. (A device told "threads=1" would hold the
  // whole program to one thread for as long as it lives.)
  tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
}

RayScene::~RayScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

}  // namespace partwise
