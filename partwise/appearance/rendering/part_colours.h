// The materials of parts under one light, made ready once for images from any number of views: a reflectance map or an
// exact sum for each material that differs (image_formation.h). The light is in camera space. Errors: those of maps.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "partwise/appearance/rendering/g_buffer.h"
#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/appearance/rendering/reflectance_map.h"

namespace partwise {

enum class RenderPath { exact, reflectance_map };

class PartColours {
 public:
  // One material a part; parts that wear the same one share what is computed of it.
  PartColours(std::span<const std::shared_ptr<const Brdf>> materials, LightSamples light, RenderPath path,
              int map_size);
  PartColours(const PartColours&) = delete;
  PartColours& operator=(const PartColours&) = delete;

  Image image(const GBuffer& seen) const;
  // With the shadows that the scene throws on itself; exact alone.
  Image shadowed_image(const GBuffer& seen, const RenderScene& scene, const Camera& camera) const;

 private:
  LightSamples light_;
  std::vector<std::shared_ptr<const Brdf>> materials_;  // that the sums refer to
  std::vector<std::unique_ptr<const LightSum>> sum_owners_;
  std::vector<std::unique_ptr<const ReflectanceMap>> map_owners_;
  std::vector<const LightSum*> sums_;  // a part, of one of the two
  std::vector<const ReflectanceMap*> maps_;
};

}  // namespace partwise
