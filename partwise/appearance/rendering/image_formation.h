// Images of what a camera sees, by the sum (3.2): linear RGB, the mean of a pixel's samples, background zero.
//
// The view direction is constant, +z, for perspective cameras too. Normals that lean away from the viewer count as the
// rim beside them. Exact: the sum for every sample, with shadows where they are asked for (a ray from each sample to
// each light pixel: slow). Mapped: samples are looked up in reflectance maps. The same bytes for any number of threads.
// Errors: CheckFailed for a part without a material.
#pragma once

#include <span>

#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/appearance/rendering/reflectance_map.h"

namespace partwise {

// One sum or map a part.
Image exact_image(const GBuffer& seen, std::span<const LightSum* const> sums);
Image mapped_image(const GBuffer& seen, std::span<const ReflectanceMap* const> maps);

// With the shadows that the scene throws on itself. `light` is that of the sums.
Image shadowed_image(const GBuffer& seen, std::span<const LightSum* const> sums, const RenderScene& scene,
                     const Camera& camera, const LightSamples& light);

// A formed image with its G-buffer's mask as straight alpha: edges keep the colour of what they are edges of.
Image on_clear_ground(const Image& formed, const Image& mask);

}  // namespace partwise
