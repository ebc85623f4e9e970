#include "partwise/geometry/linear_programme.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <limits>
#include <random>
#include <vector>

namespace partwise {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d random_unit(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
}

// The least cost over all corners of the feasible region, the cube's sides among its planes; infinity for none.
double brute_force(const Eigen::Vector3d& cost, std::vector<HalfSpace> all, double bound) {
  for (int k = 0; k < 3; ++k)
    for (double sign : {-1.0, 1.0}) all.push_back({sign * Eigen::Vector3d::Unit(k), -bound});
  double best = infinity;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        Eigen::Matrix3d rows;
        rows << all[i].normal.transpose(), all[j].normal.transpose(), all[k].normal.transpose();
        if (std::abs(rows.determinant()) < 1e-9) continue;
        const Eigen::Vector3d x = rows.inverse() * Eigen::Vector3d(all[i].offset, all[j].offset, all[k].offset);
        bool inside = true;
        for (const HalfSpace& h : all) inside = inside && h.normal.dot(x) >= h.offset - 1e-9;
        if (inside) best = std::min(best, cost.dot(x));
      }
  return best;
}

TEST(LinearProgramme, AgreesWithAllCorners) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-1, 0.4);
  int optimal = 0, unbounded = 0, infeasible = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<HalfSpace> half_spaces;
    for (int i = 0; i < trial % 16; ++i) half_spaces.push_back({random_unit(random), offset(random)});
    const Eigen::Vector3d cost = random_unit(random);
    const double bound = 10, expected = brute_force(cost, half_spaces, bound);
    const Optimum found = minimise(cost, half_spaces, bound);
    if (found.status == Optimum::Status::optimal) {
      ++optimal;
      EXPECT_NEAR(cost.dot(found.x), expected, 1e-6) << trial;
      for (const HalfSpace& h : half_spaces) EXPECT_GE(h.normal.dot(found.x), h.offset - 1e-11);
    } else if (found.status == Optimum::Status::infeasible) {
      ++infeasible;
      EXPECT_EQ(expected, infinity) << trial;
    } else {
      ++unbounded;  // In a larger cube the cost is lower still.
      EXPECT_LT(brute_force(cost, half_spaces, 1000 * bound), expected) << trial;
    }
  }
  EXPECT_GT(optimal, 500);
  EXPECT_GT(unbounded, 500);
  EXPECT_GT(infeasible, 50);
}

TEST(LinearProgramme, OfManyOptimaACornerAndNotTheCube) {
  // Every point of the floor is optimal.
  std::vector<HalfSpace> box;
  for (int k = 0; k < 3; ++k)
    for (double sign : {-1.0, 1.0}) box.push_back({sign * Eigen::Vector3d::Unit(k), -1});
  const Optimum found = minimise(Eigen::Vector3d::UnitZ(), box, 100);
  ASSERT_EQ(found.status, Optimum::Status::optimal);
  EXPECT_NEAR(found.x.z(), -1, 1e-9);
  EXPECT_LE(found.x.lpNorm<Eigen::Infinity>(), 1 + 1e-9);
}

TEST(LinearProgramme, RepeatedAndParallelPlanes) {
  const Eigen::Vector3d n = Eigen::Vector3d(1, 2, 3).normalized();
  std::vector<HalfSpace> half_spaces{{n, 0.5}, {n, 0.5}, {n, 0.25}, {-n, -0.5}};
  for (int k = 0; k < 3; ++k) half_spaces.push_back({Eigen::Vector3d::Unit(k), 0});
  const Optimum found = minimise(n, half_spaces, 10);
  ASSERT_EQ(found.status, Optimum::Status::optimal);
  EXPECT_NEAR(n.dot(found.x), 0.5, 1e-12);
  half_spaces.push_back({-n, -0.4});
  EXPECT_EQ(minimise(n, half_spaces, 10).status, Optimum::Status::infeasible);
}

}  // namespace
}  // namespace partwise
