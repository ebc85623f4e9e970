#include "partwise/appearance/rendering/part_colours.h"

#include <algorithm>
#include <utility>

#include "partwise/appearance/rendering/image_formation.h"

namespace partwise {

PartColours::PartColours(std::span<const std::shared_ptr<const Brdf>> materials, LightSamples light, RenderPath path,
                         int map_size)
    : light_(std::move(light)), materials_(materials.begin(), materials.end()) {
  for (std::size_t part = 0; part < materials_.size(); ++part) {
    const auto first = static_cast<std::size_t>(std::ranges::find(materials_, materials_[part]) - materials_.begin());
    if (path == RenderPath::reflectance_map) {
      if (first == part)
        map_owners_.push_back(std::make_unique<const ReflectanceMap>(*materials_[part], light_, map_size));
      maps_.push_back(first == part ? map_owners_.back().get() : maps_[first]);
    } else {
      if (first == part) sum_owners_.push_back(std::make_unique<const LightSum>(*materials_[part], light_));
      sums_.push_back(first == part ? sum_owners_.back().get() : sums_[first]);
    }
  }
}

Image PartColours::image(const GBuffer& seen) const {
  return maps_.empty() ? exact_image(seen, sums_) : mapped_image(seen, maps_);
}

Image PartColours::shadowed_image(const GBuffer& seen, const RenderScene& scene, const Camera& camera) const {
  return partwise::shadowed_image(seen, sums_, scene, camera, light_);
}

}  // namespace partwise
