#include "partwise/learning/view_warp.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "partwise/base/error.h"

namespace partwise {
namespace {

constexpr int side = 96;

// What a camera far away sees of the ellipsoid {A s : |s| = 1}, A in pixels, in the middle of the picture.
at::Tensor ellipsoid(const Eigen::Matrix3d& shape) {
  const Eigen::Matrix3d form = (shape * shape.transpose()).inverse();  // p . form p = 1 on the surface
  at::Tensor normals = at::zeros({3, side, side});
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Eigen::Vector2d at(column - 0.5 * (side - 1), 0.5 * (side - 1) - row);
      const double a = form(2, 2), b = at.dot(form.block<2, 1>(0, 2)), c = at.dot(form.topLeftCorner<2, 2>() * at) - 1;
      if (b * b - a * c <= 0) continue;
      const Eigen::Vector3d point(at.x(), at.y(), (-b + std::sqrt(b * b - a * c)) / a);
      const Eigen::Vector3d normal = (form * point).normalized();
      for (int i = 0; i < 3; ++i) normals[i][row][column] = normal[i];
    }
  }
  return normals;
}

TEST(ViewWarp, TakesEllipsoidsToEllipsoids) {
  const Eigen::Matrix3d ball = Eigen::Vector3d(30, 24, 27).asDiagonal();
  for (const bool mirrored : {false, true}) {
    ViewWarp warp;
    warp.plane = Eigen::Rotation2Dd(0.3) * Eigen::Vector2d(mirrored ? -1.2 : 1.2, 0.85).asDiagonal();
    warp.lean = {0.3, -0.2};
    warp.depth = 1.3;
    Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
    map.topLeftCorner<2, 2>() = warp.plane;
    map.row(2) << warp.lean.x(), warp.lean.y(), warp.depth;
    const Eigen::Matrix3d shape = map * ball;
    // Half the box of {A s} is the length of A's rows.
    warp.share = 2 * std::max(shape.row(0).norm(), shape.row(1).norm()) / side;
    const at::Tensor truth = ellipsoid(shape), found = warped_normals(ellipsoid(ball), warp);
    const at::Tensor object = truth.square().sum(0) > 0, kept = found.square().sum(0) > 0;
    EXPECT_LT((object != kept).sum().item<double>(), 0.03 * object.sum().item<double>());
    const at::Tensor cosines = (truth * found).sum(0).masked_select(object & kept);
    EXPECT_GT(cosines.mean().item<double>(), std::cos(1.5 / 57.3));
    EXPECT_LT((1 - found.square().sum(0).masked_select(kept)).abs().max().item<double>(), 1e-5);
  }
}

TEST(ViewWarp, IdentityCentresAndFits) {
  at::Tensor normals = at::zeros({3, side, side});
  normals[2].narrow(0, 0, 48).narrow(1, 10, 24).fill_(1);  // 24 x 48 pixels, up against the upper edge
  ViewWarp warp;
  warp.share = 0.5;
  const at::Tensor found = warped_normals(normals, warp);
  at::Tensor expected = at::zeros({side, side});
  expected.narrow(0, 24, 48).narrow(1, 36, 24).fill_(1);
  EXPECT_TRUE(found[2].equal(expected));
  EXPECT_TRUE(warped_normals(at::zeros({3, side, side}), warp).eq(0).all().item<bool>());
  warp.plane.setZero();
  EXPECT_THROW(warped_normals(normals, warp), CheckFailed);
}

// Parts that are bands of normals: bands they stay.
TEST(ViewWarp, PartsGoWithTheirNormals) {
  const at::Tensor normals = ellipsoid(Eigen::Vector3d(30, 24, 27).asDiagonal());
  const at::Tensor object = (normals.square().sum(0) > 0);
  const at::Tensor parts = (object.to(at::kByte) + (normals[0] > 0).to(at::kByte)).to(at::kByte);  // left 1, right 2
  ViewWarp warp;
  warp.plane = Eigen::Vector2d(-1.2, 0.85).asDiagonal();  // left and right exchanged
  warp.share = 0.9;
  const at::Tensor turned = warped_normals(normals, warp), found = warped_parts(parts, warp);
  EXPECT_TRUE((found > 0).equal(turned.square().sum(0) > 0));
  const at::Tensor clear = turned[0].abs() > 0.1;
  EXPECT_GT(clear.sum().item<int>(), 2000);
  EXPECT_TRUE((found == 1).logical_and(clear).equal((turned[0] > 0.1)));
  EXPECT_TRUE((found == 2).logical_and(clear).equal((turned[0] < -0.1)));
  const at::Tensor nothing = at::zeros({side, side}, at::kByte);
  EXPECT_TRUE(warped_parts(nothing, warp).equal(nothing));
  EXPECT_THROW(warped_parts(normals, warp), CheckFailed);
}

}  // namespace
}  // namespace partwise
