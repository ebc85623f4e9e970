#include "partwise/normals/truth/pinhole_camera.h"

#include "partwise/appearance/camera.h"
#include "partwise/base/error.h"

namespace partwise {

PinholeCamera pinhole_camera(const Camera& camera, int width, int height) {
  PARTWISE_CHECK(camera.orthographic, ==, false);
  PARTWISE_CHECK(camera.half_height, >, 0);
  const double focal = height / (2 * camera.half_height);
  return {focal, focal, (width - 1) / 2.0, (height - 1) / 2.0};
}

}  // namespace partwise
