// Linear programmes in three unknowns: the x with the least cost . x in the common part of half-spaces and a cube.
//
// The dual simplex method (Lemke 1954) with partial pricing: half-spaces are looked at eight at a time in the order
// given, and the most violated one enters, so put those first that are likely to matter. The basis is three planes,
// inverted afresh in every step, so that no error builds up. Made for ten or so half-spaces: well below a microsecond.
//
// Where a whole edge or facet is optimal, the corner of it is taken that lies deepest against all half-spaces together:
// the cost has a billionth of their normals' sum added. Deterministic.
#pragma once

#include <Eigen/Core>

#include <span>

namespace partwise {

// normal . x >= offset, with a normal of unit length.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

struct Optimum {
  enum class Status {
    optimal,
    unbounded,   // the optimum lies on a side of the cube or outside of it
    infeasible,  // no point of the cube lies in all half-spaces, to 1e-12
  };
  Status status = Status::infeasible;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();  // on infeasible: of no meaning
};

// The cube is |x_k| <= bound; x and offsets should be of the order of one.
Optimum minimise(const Eigen::Vector3d& cost, std::span<const HalfSpace> half_spaces, double bound);

}  // namespace partwise
