// How far two rigid meshes are from each other, and whether they touch, by FCL (Pan, Chitta, Manocha 2012): trees of
// oriented boxes and rectangle swept spheres over triangles (Gottschalk, Lin, Manocha 1996; Larsen, Gottschalk, Lin,
// Manocha 1999). Surfaces only: one inside the other does not touch it.
//
// FCL's distance of triangles takes those whose normal is shorter than 3e-8 for degenerate, in whatever unit, and then
// says 0 or too much. So meshes are scaled for it by a power of two, which rounds nothing: `proximity_scale` of the
// size of all that will be compared, the same for all.
#pragma once

#include <Eigen/Geometry>

#include <memory>
#include <optional>

#include "partwise/geometry/mesh.h"

namespace partwise {

double proximity_scale(double size);  // a power of two

class ProximityMesh {
 public:
  ProximityMesh(const Mesh& mesh, double scale);  // which has a face
  ~ProximityMesh();
  ProximityMesh(ProximityMesh&&) noexcept;
  ProximityMesh& operator=(ProximityMesh&&) noexcept;

  struct Witness {
    double distance = 0;
    Eigen::Vector3d here = Eigen::Vector3d::Zero(), there = Eigen::Vector3d::Zero();  // nearest points, where it is > 0
  };
  // Of this, which stays where it is, and another one at `pose`; nothing unless nearer than `below`.
  std::optional<Witness> nearest(const ProximityMesh& other, const Eigen::Isometry3d& pose, double below) const;
  bool touches(const ProximityMesh& other, const Eigen::Isometry3d& pose) const;

 private:
  struct Model;
  double scale_ = 1;
  std::unique_ptr<Model> model_;
};

}  // namespace partwise
