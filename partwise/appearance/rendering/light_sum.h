// The sum (3.2) of the dissertation, exactly: what a surface of one material sends to the viewer under one light,
//
//   I(n) = sum over light pixels of f(w_i, w_o) L(w_i) max(0, n . w_i) dw_i,   w_o = +z.
//
// Any material will do. For a Dsbrdf the lobes depend on the light alone once the view is constant: they are taken once
// a light pixel, and the rest is 19 exponentials a pair of normal and pixel, eight pairs at a time in single precision.
// Linear RGB. Normals are in camera space, of unit length; a normal that turns away from the viewer sees the material
// at its rim. Sums run in one order: the same bytes for any number of threads.
#pragma once

#include <Eigen/Core>

#include <span>
#include <vector>

#include "partwise/appearance/material/dsbrdf.h"
#include "partwise/appearance/rendering/environment_light.h"

namespace partwise {

class LightSum {
 public:
  // Both must outlive this.
  LightSum(const Brdf& material, const LightSamples& light);

  // visible: of each light sample the share that arrives, or nothing, then all of it.
  Eigen::Vector3f colour(const Eigen::Vector3f& normal, const float* visible = nullptr) const;
  // On all threads.
  std::vector<Eigen::Vector3f> colours(std::span<const Eigen::Vector3f> normals) const;

 private:
  Eigen::Vector3f lobes_colour(const Eigen::Vector3f& normal, const float* visible) const;
  Eigen::Vector3f any_colour(const Eigen::Vector3f& normal, const float* visible) const;

  const Brdf& material_;
  const LightSamples& light_;
  // Of a Dsbrdf: half-vectors, and kappa and gamma of the lobes; row i of light sample i. Columns: 3 channel + lobe.
  bool has_lobes_ = false;
  Eigen::ArrayX3f half_;
  Eigen::Array<float, Eigen::Dynamic, 9> kappa_, gamma_;
};

// The half-vector between a direction of light and +z; of light from straight behind, where there is none, +x.
Eigen::Vector3d half_vector(const Eigen::Vector3d& to_light);
Eigen::ArrayX3f half_vectors(const LightSamples& light);

}  // namespace partwise
