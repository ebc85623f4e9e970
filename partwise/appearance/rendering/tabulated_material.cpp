#include "partwise/appearance/rendering/tabulated_material.h"

#include "partwise/appearance/rendering/halfway_table.h"

namespace partwise {

TabulatedMaterial::TabulatedMaterial(const Dsbrdf& material)
    : material_(material), table_(std::make_unique<const HalfwayTable>(material)) {}
TabulatedMaterial::~TabulatedMaterial() = default;

Eigen::Vector3f TabulatedMaterial::operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const {
  return material_(to_light, to_viewer);
}

std::size_t TabulatedMaterial::bytes() const { return sizeof(*this) + HalfwayTable::rows * sizeof(HalfwayTable::Row); }

}  // namespace partwise
