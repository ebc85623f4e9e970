// What coefficient_images.h promises, in plain C++, for one image. Internal to this room.
//
// Planes as in differentiable_sum.h; psi n x K, a column a component; radiance (height * width) x 3. Blocks of pixels
// are independent but for the derivatives to the light, which are summed in their order.
#pragma once

#include <vector>

#include "partwise/learning/differentiable_sum.h"

namespace partwise {

template <typename Scalar>
using Numbers = Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <typename Scalar>
using NumbersRef = Eigen::Ref<const Numbers<Scalar>>;

template <typename Scalar>
struct CoefficientGradient {
  Planes<Scalar> normals, radiance;
  Numbers<Scalar> psi;
};

template <typename Scalar>
class CoefficientSum {
 public:
  // The grid must outlive this. components: 108 x K, a column each.
  CoefficientSum(const std::vector<LightPixel<Scalar>>& grid, const Coefficients<Scalar>& mean,
                 const NumbersRef<Scalar>& components, const PlanesRef<Scalar>& radiance);

  Planes<Scalar> colours(const PlanesRef<Scalar>& normals, const NumbersRef<Scalar>& psi) const;
  CoefficientGradient<Scalar> gradient(const PlanesRef<Scalar>& normals, const NumbersRef<Scalar>& psi,
                                       const PlanesRef<Scalar>& of_colours) const;

 private:
  struct Some;
  struct Lobes;

  const std::vector<LightPixel<Scalar>>& grid_;
  Coefficients<Scalar> mean_;
  Numbers<Scalar> components_;
  Planes<Scalar> weights_;  // radiance times solid angle
};

}  // namespace partwise
