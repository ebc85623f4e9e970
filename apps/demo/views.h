// Models seen by a camera, in materials and under light, and what is known of each pixel, as pictures. A picture for
// make_picture (html.h) is linear, which loses what is a code already.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/environment_light.h"
#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/geometry/mesh.h"
#include "partwise/imaging/image.h"

namespace demo {

struct WornModel {
  std::string name;
  partwise::Mesh mesh;
  std::vector<int> parts;  // a face
};

// From `azimuth` degrees; the model covers `share` of the frame.
partwise::GBuffer view_of(const WornModel& model, double azimuth, int size, double share);

partwise::EnvironmentLight resized_light(const std::string& name, int rows);
std::vector<partwise::Dsbrdf> brdfs_of(const std::vector<std::string>& names);

// The view in these materials, one a part: linear RGB. By maps of few texels, or by patches of light where `fine`.
partwise::Image worn_image(const partwise::GBuffer& seen, const std::vector<partwise::Dsbrdf>& materials,
                           const partwise::EnvironmentLight& light, bool fine);
// The same on clear ground, exposed for a grey card.
partwise::Image worn_picture(const partwise::GBuffer& seen, const std::vector<partwise::Dsbrdf>& materials,
                             const partwise::EnvironmentLight& light, bool fine);

// colour(pixel) with the alpha of the mask.
template <typename Colour>
partwise::Image masked(const partwise::Image& mask, const Colour& colour) {
  partwise::Image image(mask.width, mask.height, 4);
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    const Eigen::Vector3f value = colour(i);
    std::copy_n(value.data(), 3, &image.values[4 * i]);
    image.values[4 * i + 3] = mask.values[i];
  }
  return image;
}

partwise::Image from_codes(partwise::Image codes);
partwise::Image for_the_eye(const partwise::Image& linear, float exposure);

partwise::Image normals_of(const partwise::GBuffer& seen);
partwise::Image depth_of(const partwise::GBuffer& seen);
partwise::Image parts_of(const partwise::GBuffer& seen);
partwise::Image mask_of(const partwise::GBuffer& seen);

}  // namespace demo
