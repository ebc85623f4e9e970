// A material under a light as the colour of each normal: with light from far away and one constant view (+z), the sum
// (3.2) depends on the normal alone, so it is taken once for a small map of normals and pixels are looked up.
//
// The map is the equal-area disk of normal_disk.h, its rim one texel inside the map's sides. Texels beyond the rim,
// which lookups near it need, hold what their normals, turned away a little, would show: the light's cosine goes on,
// and so does the material (a Dsbrdf by its formula, any other as it is seen at its rim). So lookups are alike
// everywhere. They are bicubic (Catmull and Rom 1974): sharp lobes are as narrow as a few texels, and bilinear ones
// flatten their peaks.
//
// For a Dsbrdf the sum goes over a table of the material (halfway_table.h), for any other it is the exact one. The same
// bytes for any number of threads. Linear RGB. Errors: CheckFailed for a size below 8.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "partwise/appearance/rendering/light_sum.h"
#include "partwise/appearance/rendering/light_tree.h"
#include "partwise/imaging/image.h"

namespace partwise {

class ReflectanceMap {
 public:
  ReflectanceMap(const Brdf& material, const LightSamples& light, int size = 64);
  // By patches of light, for fine maps of light and mirror-like materials.
  ReflectanceMap(const PatchSum& sum, int size);

  // Of a unit normal in camera space; one that turns away from the viewer counts as the rim beside it.
  Eigen::Vector3f colour(const Eigen::Vector3f& normal) const;

  // size x size, 3 channels; zero where no lookup goes.
  const Image& image() const { return image_; }
  // The texels that were computed.
  int normals() const { return normals_; }

 private:
  template <typename Colours>
  void fill(const Colours& colours_of);

  Image image_;
  int normals_ = 0;
};

}  // namespace partwise
