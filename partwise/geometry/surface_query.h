// Questions about a fixed surface in space: how far, inside or outside, on Embree's bounding volume hierarchy.
//
// Distances are exact to single precision of the mesh's size (positions are centred and scaled before they are rounded
// to float): about 1e-6 R. Faces without area are segments or points to distances, and nothing to rays. All queries are
// const and may run in parallel; answers do not depend on the number of threads. Errors: InputError for a mesh without
// a face of positive area.
#pragma once

#include <memory>

#include "partwise/geometry/mesh.h"

namespace partwise {

class SurfaceQuery {
 public:
  explicit SurfaceQuery(const Mesh& mesh);
  ~SurfaceQuery();
  SurfaceQuery(SurfaceQuery&&) noexcept;
  SurfaceQuery& operator=(SurfaceQuery&&) noexcept;

  // Distance from p to the nearest point of the surface; `at_most` bounds the search and is returned if nothing is
  // nearer.
  double distance(const Point& p, double at_most = 1e30) const;

  // The winding number of the surface about p as rays see it: the mean over fixed directions of the signed number of
  // faces that the ray leaves through. A whole number for closed meshes (three directions that outvote a grazing ray);
  // for open meshes the share of directions in which the surface is met from inside.
  double winding_number(const Point& p) const;

  // The nearest face that the ray from p meets farther than `from`, either side; face -1 if there is none.
  struct Hit {
    int face = -1;
    double distance = 0;
  };
  Hit first_hit(const Point& p, const Point& direction, double from) const;

  bool contains(const Point& p) const { return winding_number(p) > 0.5; }

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace partwise
