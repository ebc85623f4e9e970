#include "partwise/motion/margin_field.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/motion/axis_samples.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/point_scene.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

// Two classes along facing sides of a gap of 2, about x = 0.
MotionPoints facing_sides() {
  MotionPoints points(42, 2);
  for (int i = 0; i < 21; ++i) {
    points.row(i) << 1, -5 + 0.5 * i;
    points.row(21 + i) << -1, -5 + 0.5 * i;
  }
  return points;
}

TEST(MarginClassifier, IsZeroHalfWayAndOneAtTheSides) {
  const MarginClassifier f(facing_sides(), 21, {.width = 2, .cost = 1000});
  for (double y = -4; y <= 4; y += 0.25) {
    EXPECT_NEAR(f.value(MotionVector{{0.0, y}}), 0, 0.01);
    EXPECT_NEAR(f.value(MotionVector{{1.0, y}}), 1, 0.1);
    EXPECT_NEAR(f.value(MotionVector{{-1.0, y}}), -1, 0.1);
  }
}

TEST(MarginClassifier, HasTheGradientOfItsValue) {
  Draw draw(1, 0, 0);
  for (const int dimension : {2, 3, 4, 12}) {
    MotionPoints points(60, dimension);
    for (auto row : points.rowwise()) {
      for (double& each : row) each = draw.within(-1, 1);
    }
    points.col(0).head(25).array() += 1;
    const MarginClassifier f(points, 25, {.width = 0.8, .cost = 10});
    for (int i = 0; i < 20; ++i) {
      MotionVector x(dimension);
      for (double& each : x) each = draw.within(-1.5, 1.5);
      const FieldValue at = f.at(x);
      EXPECT_NEAR(at.value, f.value(x), 1e-12);
      for (int k = 0; k < dimension; ++k) {
        constexpr double h = 1e-5;
        const MotionVector by = h * MotionVector::Unit(dimension, k);
        EXPECT_NEAR(at.gradient[k], (f.value(x + by) - f.value(x - by)) / (2 * h), 1e-6);
      }
    }
  }
}

// Which class is above 0 is decided by the caller's order, not by what libsvm met first.
TEST(MarginClassifier, KeepsItsSign) {
  MotionPoints points = facing_sides();
  EXPECT_GT(MarginClassifier(points, 21, {.width = 2}).value(MotionVector{{0.7, 0.0}}), 0);
  points.col(0) *= -1;
  EXPECT_LT(MarginClassifier(points, 21, {.width = 2}).value(MotionVector{{0.7, 0.0}}), 0);
}

struct Grid {
  std::unique_ptr<Scene> scene;
  ContactSamples contacts;
};

// Squares of side 4 at distances of 10: each pair's axis is a line of the grid.
Grid square_grid(int side) {
  std::vector<Polygons> obstacles;
  std::vector<Ring> hulls;
  std::vector<int> numbers;
  for (int i = 0; i < side * side; ++i) {
    const double x = 10.0 * (i % side), y = 10.0 * (i / side);
    obstacles.push_back(rectangle(x - 2, y - 2, x + 2, y + 2));
    hulls.push_back(obstacles.back()[0].outer);
    numbers.push_back(i);
  }
  const double end = 10.0 * (side - 1) + 5;
  return {point_scene(obstacles, Eigen::AlignedBox2d(Eigen::Vector2d(-5, -5), Eigen::Vector2d(end, end))),
          contact_samples(hulls, numbers, 100)};
}

// Of points where three obstacles are told apart clearly, the share at which the field names the two nearest in order.
double share_named_right(const Grid& grid, const MarginFieldSettings& settings) {
  const MarginField field(grid.scene->space(), grid.contacts, settings);
  int right = 0, asked = 0;
  for (int i = 0; i < 2000; ++i) {
    Draw draw(3, static_cast<std::uint64_t>(i), 0);
    const Configuration q = grid.scene->space().drawn(draw);
    const std::vector<Near> near = grid.scene->nearest(q, 3);
    if (!grid.scene->free(q) || near[2].distance - near[1].distance < 0.5 || near[1].distance - near[0].distance < 0.2)
      continue;  // a matter of taste
    ++asked;
    const auto named = field.nearest_two(q);
    right += named[0] == near[0].obstacle && named[1] == near[1].obstacle;
  }
  EXPECT_GT(asked, 500);
  return static_cast<double>(right) / asked;
}

TEST(MarginField, NamesTheTwoNearest) { EXPECT_GT(share_named_right(square_grid(5), {}), 0.9); }

// Farther ones decide little.
TEST(MarginField, TheNearestSamplesOfOthersDecide) {
  const Grid grid = square_grid(5);
  const MarginFieldSettings all{.density = 0, .most_others = 100000}, few{.density = 0, .most_others = 80};
  EXPECT_GT(share_named_right(grid, few), share_named_right(grid, all) - 0.05);
  const ConfigurationSpace& space = grid.scene->space();
  const int of_few = MarginField(space, grid.contacts, few).size().supports_against_others,
            of_all = MarginField(space, grid.contacts, all).size().supports_against_others;
  EXPECT_LT(of_few, of_all);
}

TEST(MarginField, TrainsNeighboursOnly) {
  const Grid grid = square_grid(6);
  const MarginField field(grid.scene->space(), grid.contacts);
  const int pairs = field.size().pairs;
  EXPECT_GE(pairs, 60);            // the sides of the grid
  EXPECT_LE(pairs, 60 + 50 + 20);  // and its diagonals; along the rim a few more, of all 630
  const double far = field.between(35, 0).value(MotionVector{{5.0, 5.0}});  // trained now
  EXPECT_GT(far, 0);
  EXPECT_EQ(field.size().pairs, pairs + 1);
}

TEST(MarginField, NeedsTwoObstacles) {
  const Grid grid = square_grid(1);
  EXPECT_THROW(MarginField(grid.scene->space(), grid.contacts), InputError);
}

double distance_from_lines(const Configuration& q) {
  // Lines x = 5 + 10 i or y = 5 + 10 i.
  const auto off = [](double v) { return std::abs(std::remainder(v - 5, 10.0)); };
  return std::min(off(q[0]), off(q[1]));
}

TEST(MarginPush, ArrivesOnTheAxisOfAGrid) {
  const Grid grid = square_grid(5);
  const MarginField field(grid.scene->space(), grid.contacts);
  for (const StepSize step : {StepSize::clearance, StepSize::combined}) {
    const MarginPush push(*grid.scene, field, {.step = step});
    const AxisSamples found = axis_samples(*grid.scene, push, {.count = 1000});
    ASSERT_EQ(found.samples.size(), 1000u);
    EXPECT_LT(found.lost, found.drawn / 5);
    EXPECT_EQ(found.share_on_axis(), 1);
    for (const AxisSample& each : found.samples) {
      EXPECT_TRUE(grid.scene->free(each.q));
      EXPECT_LT(distance_from_lines(each.q), 0.01 * each.state.clearance() + 1e-9);
    }
  }
}

TEST(MarginPush, ScoreAloneComesNear) {
  const Grid grid = square_grid(5);
  const MarginField field(grid.scene->space(), grid.contacts);
  const MarginPush push(*grid.scene, field, {.step = StepSize::score});
  const AxisSamples found = axis_samples(*grid.scene, push, {.count = 500, .only_on_axis = false});
  ASSERT_EQ(found.samples.size(), 500u);
  double sum = 0;
  for (const AxisSample& each : found.samples) sum += distance_from_lines(each.q);
  EXPECT_LT(sum / 500, 0.3);  // raw points are 1.6 away
}

TEST(MarginPush, IsTheSameForAnyNumberOfThreads) {
  const Grid grid = square_grid(4);
  std::vector<Configuration> first;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const MarginField field(grid.scene->space(), grid.contacts);
    const AxisSamples found = axis_samples(*grid.scene, MarginPush(*grid.scene, field), {.count = 300});
    if (first.empty()) {
      for (const AxisSample& each : found.samples) first.push_back(each.q);
      continue;
    }
    ASSERT_EQ(found.samples.size(), first.size());
    for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(found.samples[i].q, first[i]);
  }
}

// Two rectangles that touch are equally far from all points before the seam, which are on no axis.
TEST(MedialAxis, DoesNotSeeSeams) {
  const auto scene =
      point_scene(std::vector<Polygons>{rectangle(0, 0, 5, 5), rectangle(5, 0, 10, 5), rectangle(0, 15, 10, 20)},
                  Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(10, 20)));
  EXPECT_FALSE(axis_state(*scene, Configuration{{5.0, 8.0}}).on_axis());
  const AxisState middle = axis_state(*scene, Configuration{{5.0, 10.0}});
  EXPECT_TRUE(middle.on_axis());
  EXPECT_EQ(middle.pair[1].obstacle, 2);
}

}  // namespace
}  // namespace partwise
