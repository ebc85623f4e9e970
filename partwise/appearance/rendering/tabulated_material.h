// A Dsbrdf with the table that reflectance maps sum over made ready, for a material that many maps are made of: the
// same maps to the bit, without the milliseconds that the table takes. Errors: none.
#pragma once

#include <cstddef>
#include <memory>

#include "partwise/appearance/material/dsbrdf.h"

namespace partwise {

class HalfwayTable;

class TabulatedMaterial final : public Brdf {
 public:
  explicit TabulatedMaterial(const Dsbrdf& material);
  ~TabulatedMaterial() override;
  TabulatedMaterial(const TabulatedMaterial&) = delete;
  TabulatedMaterial& operator=(const TabulatedMaterial&) = delete;

  Eigen::Vector3f operator()(const Eigen::Vector3f& to_light, const Eigen::Vector3f& to_viewer) const override;
  const Dsbrdf& material() const { return material_; }
  const HalfwayTable& table() const { return *table_; }
  std::size_t bytes() const;

 private:
  Dsbrdf material_;
  std::unique_ptr<const HalfwayTable> table_;
};

}  // namespace partwise
