// Light in patches of patches, so that the sum (3.2) of light_sum.h can be taken over a few hundred of them instead of
// all pixels of a fine map: near the direction that a surface mirrors to the viewer pixel by pixel, elsewhere in
// patches so large that the material hardly changes across them (hierarchies of lights as in Walter et al. 2005,
// "Lightcuts: a scalable approach to illumination").
//
// A patch stands for its pixels by their sum and their mean direction, both weighted by what they bring, so that what
// is left out is of second order in its spread. It is taken as a whole where, seen from the half-vector, its radius is
// less than `fineness` of the distance to the normal; 0 gives the sum over all pixels. The same bytes for any number of
// threads. Linear RGB; directions in camera space, the viewer at +z. Errors: CheckFailed for a negative fineness.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <span>
#include <vector>

#include "partwise/appearance/material/brdf.h"
#include "partwise/appearance/rendering/environment_light.h"

namespace partwise {

class HalfwayTable;

struct LightPatch {
  Eigen::Vector3f direction, half;  // half: the half-vector with the viewer
  Eigen::Vector3f radiance;         // times solid angle
  // From `direction`, 0 for a pixel: the root mean square distance of its pixels, weighted by what they bring, and a
  // bound on that of any. A patch with the sun in it has next to no spread, and yet sky all over its radius.
  float spread = 0, radius = 0;
  int first = 0, children = 0;  // a patch's children stand one after the other
};

class LightTree {
 public:
  // The directions are those of the map turned by `rotation`, as in light_samples.
  explicit LightTree(const EnvironmentLight& light, const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity());

  const std::vector<LightPatch>& patches() const { return patches_; }
  int largest() const { return largest_; }  // so many at the front are nobody's children

 private:
  std::vector<LightPatch> patches_;
  int largest_ = 0;
};

class PatchSum {
 public:
  // Both must outlive this.
  PatchSum(const Brdf& material, const LightTree& light, double fineness = 0.25);
  ~PatchSum();
  PatchSum(PatchSum&&) noexcept;
  PatchSum& operator=(PatchSum&&) noexcept;

  Eigen::Vector3f colour(const Eigen::Vector3f& normal) const;
  std::vector<Eigen::Vector3f> colours(std::span<const Eigen::Vector3f> normals) const;  // on all threads

 private:
  template <typename Visit>
  void visit_cut(const Eigen::Vector3f& normal, const Visit& visit) const;

  const Brdf* material_;
  const LightTree* light_;
  float fineness_, sharpest_;  // sharpest_: half-vectors this near to the normal are all alike to the material
  std::unique_ptr<HalfwayTable> table_;  // of a Dsbrdf
};

}  // namespace partwise
