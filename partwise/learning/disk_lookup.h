// Lookups in reflectance maps, with derivatives: the colours of pixels from those of a map's texels.
//
// The map is the disk of appearance/rendering/normal_disk.h and lookups are those of its ReflectanceMap: bicubic, and
// cut off below zero. (Bilinear ones flatten sharp highlights, and their derivatives jump from texel to texel.) Where a
// colour is cut off, its derivatives are zero. The texels' colours may come from anywhere; DifferentiableSum gives them
// and takes their derivatives back.
//
// Shapes: planes as in differentiable_sum.h, texels in the order of normals(). A zero normal is background: zero
// colour, zero gradient. Blocks of pixels are summed apart and then in order: the same bits for any number of threads.
// Errors: CheckFailed for a size below 8, and where sizes do not agree.
#pragma once

#include <vector>

#include "partwise/learning/differentiable_sum.h"

namespace partwise {

template <typename Scalar>
struct LookupGradient {
  Planes<Scalar> texels, normals;
};

template <typename Scalar>
class DiskLookup {
 public:
  explicit DiskLookup(int size = 64);  // texels along a side

  const Planes<Scalar>& normals() const { return normals_; }  // of the texels that lookups reach

  Planes<Scalar> colours(const PlanesRef<Scalar>& texels, const PlanesRef<Scalar>& normals) const;
  LookupGradient<Scalar> gradient(const PlanesRef<Scalar>& texels, const PlanesRef<Scalar>& normals,
                                  const PlanesRef<Scalar>& of_colours) const;

 private:
  struct Lookup;

  int size_;
  Planes<Scalar> normals_;
  std::vector<int> texel_;  // at each place of the map, row by row; -1 where no lookup goes
};

}  // namespace partwise
