// The sum (3.2) of the dissertation (section 3.3.1) for a Dsbrdf, with its derivatives to all that enters it:
//
//   I_c(n) = sum over light pixels i of f_c(n . h_i; theta_d_i) L_ci max(0, n . w_i) dw_i.
//
// f is the material's formula as appearance/material/dsbrdf.h states it, with the same bounds: where a bound holds, the
// derivative beyond it is zero. The colours are those of appearance/rendering's LightSum (floats: within 1e-4 of them).
//
// Shapes: normals and colours are n x 3, one column a component, as planes of an image lie in memory; radiance is
// (height * width) x 3, row by row; the material 108 coefficients. Units: linear RGB radiance in and out, per steradian
// inside. Normals have unit length in camera space (+z towards the viewer); a zero normal is background: zero colour,
// zero gradient. Derivatives to normals are those of n . w and n . h in all three components of n, along n too.
// Radiance may be negative, as a network's output may be; the sum is linear in it.
//
// Floats go eight normals at a time, doubles one by one. Blocks of normals times blocks of light are summed apart and
// then together in one order: the same bits for any number of threads. A pair of normal and light pixel costs 19
// exponentials, less where a lobe is too weak to be seen by floats. Errors: CheckFailed where sizes do not agree.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "partwise/learning/light_grid.h"

namespace partwise {

template <typename Scalar>
using Planes = Eigen::Array<Scalar, Eigen::Dynamic, 3>;
template <typename Scalar>
using PlanesRef = Eigen::Ref<const Planes<Scalar>>;

// n x 3 * pixels: what a normal shows in channel c of light pixel i for each unit of its radiance, in column
// c * pixels + i.
template <typename Scalar>
using TransportRef = Eigen::Ref<Eigen::Array<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;

// What is not wanted is left empty, the material's zero.
struct GradientWanted {
  bool normals = true, material = true, radiance = true;
};

template <typename Scalar>
struct SumGradient {
  Planes<Scalar> normals;
  Coefficients<Scalar> material = Coefficients<Scalar>::Zero();
  Planes<Scalar> radiance;
};

template <typename Scalar>
class DifferentiableSum {
 public:
  // The grid must outlive this.
  DifferentiableSum(const std::vector<LightPixel<Scalar>>& grid, const Coefficients<Scalar>& material,
                    const PlanesRef<Scalar>& radiance);

  Planes<Scalar> colours(const PlanesRef<Scalar>& normals) const;

  // The colours as a product with any radiance: for many lights on one material.
  void find_transport(const PlanesRef<Scalar>& normals, TransportRef<Scalar> result) const;

  // Of a function of the colours whose derivatives to them are `of_colours`.
  SumGradient<Scalar> gradient(const PlanesRef<Scalar>& normals, const PlanesRef<Scalar>& of_colours,
                               GradientWanted wanted = {}) const;

 private:
  struct Block;
  struct LightShare;
  template <typename Use>
  void for_lit(std::size_t light, const Block& normals, const Use& use) const;
  void add_colours(std::size_t light, const Block& normals, Block& colours) const;
  void add_gradient(std::size_t light, const Block& normals, const Block& of_colours, GradientWanted wanted,
                    Block& of_normals, LightShare& of_light) const;

  const std::vector<LightPixel<Scalar>>& grid_;
  std::vector<PixelLobes<Scalar>> lobes_;
  Planes<Scalar> weights_;  // radiance times solid angle
};

}  // namespace partwise
