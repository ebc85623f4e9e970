// Linear programmes in three unknowns: the x with the least cost . x in the common part of half-spaces and a cube.
//
// Seidel 1991, "Small-dimensional linear programming and convex hulls made easy": half-spaces are added one after the
// other; where the new one cuts the optimum off, the new optimum lies on its plane, a programme in one unknown less.
// Expected time is linear in the number of half-spaces when their order is random; the order given is kept, so that the
// same input gives the same bits.
//
// Of several optima one with coordinates near zero is taken: put the origin where the solution is wanted.
#pragma once

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace partwise {

// normal . x >= offset, with a normal of unit length.
struct HalfSpace {
  Eigen::Vector3d normal;
  double offset;
};

// Keeps its memory between calls: one object a thread.
class LinearProgramme {
 public:
  enum class Status {
    optimal,
    unbounded,   // the optimum in the cube touches a side of the cube
    infeasible,  // no point of the cube lies in all half-spaces, to 1e-12
  };

  // The cube is |x_k| <= bound; coordinates and offsets should be of the order of one.
  Status solve(const Eigen::Vector3d& cost, std::span<const HalfSpace> half_spaces, double bound, Eigen::Vector3d& x);

 private:
  template <int D>
  struct Row {
    std::array<double, D> normal;
    double offset;
  };
  template <int D>
  bool minimise(const std::array<double, D>& cost, const Row<D>* rows, std::size_t count, std::array<double, D>& x);

  double bound_ = 0, negligible_ = 0;
  std::vector<Row<3>> rows3_;
  std::vector<Row<2>> rows2_;
  std::vector<Row<1>> rows1_;
};

}  // namespace partwise
