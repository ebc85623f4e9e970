#include "partwise/parts/solid/outside_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "partwise/geometry/test_shapes.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

struct Solid {
  explicit Solid(const Mesh& shape, double resolution_asked)
      : mesh(shape),
        closed(is_watertight(mesh)),
        surface(mesh),
        resolution(resolution_asked),
        outside(surface, closed, bounding_sphere(mesh), resolution) {}

  double distance(const Point& p) const { return closed && surface.contains(p) ? 0 : surface.distance(p); }

  Mesh mesh;
  bool closed;
  SurfaceQuery surface;
  double resolution;
  OutsideDistance outside;
};

// The largest distance of sampled points of the body: a lower bound.
double sampled(const Solid& solid, const Mesh& body, std::mt19937_64& random, int count = 2000) {
  std::exponential_distribution<double> weight;
  double reach = 0;
  for (int i = 0; i < count; ++i) {
    Point p = Point::Zero();
    double sum = 0;
    for (const auto& v : body.vertices.rowwise()) {
      const double w = std::pow(weight(random), 4);  // mostly near one corner
      sum += w;
      p += w * v;
    }
    reach = std::max(reach, solid.distance(p / sum));
  }
  for (const auto& v : body.vertices.rowwise()) reach = std::max(reach, solid.distance(v));
  return reach;
}

std::vector<Mesh> solids() {
  return {test::normalised(test::l_shape(6, 2)),
          test::normalised(
              test::cells_mesh(test::without(test::block({0, 0, 0}, {5, 5, 5}), test::block({1, 1, 1}, {4, 4, 4})))),
          test::normalised(test::sheet(6, 3))};
}

TEST(OutsideDistance, CertifiesNothingThatSamplesRefute) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const Mesh& mesh : solids()) {
    Solid solid(mesh, 0.02);
    int within = 0, without = 0;
    for (int round = 0; round < 60; ++round) {
      Vertices corners = (0.05 + 0.4 * unit(random)) * test::cloud(test::Cloud::sphere, 8, random);
      corners.rowwise() += 0.5 * test::cloud(test::Cloud::box, 1, random).row(0);
      const Mesh body = convex_hull(corners, 1e-4).mesh;
      const double least = sampled(solid, body, random);
      const OutsideDistance::Reach reach = solid.outside.reach(ConvexBody(body));
      EXPECT_GE(reach.distance, least - 1e-5);
      EXPECT_GE(solid.distance(reach.where), reach.distance - 0.5 * std::sqrt(3.0) * solid.resolution - 1e-5);
      for (double tolerance : {0.02, 0.05, 0.1, 0.2, 0.4}) {
        const bool certified = solid.outside.within(ConvexBody(body), tolerance);
        (certified ? within : without) += 1;
        if (certified) {
          EXPECT_LE(least, tolerance + 1e-5);
        } else {
          EXPECT_GT(reach.distance, tolerance - 1e-6);
        }
        if (tolerance > reach.distance + 1e-6) {
          EXPECT_TRUE(certified);
        }
      }
    }
    EXPECT_GT(within, 20);
    EXPECT_GT(without, 20);
  }
}

// Blunt bodies whose reach is known: boxes about a box.
TEST(OutsideDistance, RefusesAtMostWhatLiesWithinTwoDiagonals) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0, 1);
  const Mesh mesh = test::box(Point(-0.5, -0.5, -0.5), Point(0.5, 0.5, 0.5));
  Solid solid(mesh, 0.03);
  const double diagonal = std::sqrt(3.0) * solid.resolution;
  for (int round = 0; round < 200; ++round) {
    Point low, high;
    for (int k = 0; k < 3; ++k) low[k] = -0.1 - 0.7 * unit(random), high[k] = 0.1 + 0.7 * unit(random);
    const Point past = (-low).cwiseMax(high).array() - 0.5;
    const double exact = past.cwiseMax(0).norm();
    const ConvexBody body(test::box(low, high));
    const OutsideDistance::Reach reach = solid.outside.reach(body);
    EXPECT_GE(reach.distance, exact - 1e-6);
    EXPECT_LE(reach.distance, exact + 2 * diagonal);
    EXPECT_TRUE(solid.outside.within(body, exact + 2 * diagonal));
    if (exact > 0.01) {
      EXPECT_FALSE(solid.outside.within(body, exact - 1e-3));
    }
  }
}

TEST(OutsideDistance, HullOfAUShape) {
  // A notch 6 wide and 9 deep: its upper rim's middle is 3 from either wall, and so is what lies below.
  Mesh mesh = test::u_shape(12, 3);
  const Sphere sphere = bounding_sphere(mesh);
  Solid solid(mesh, 0.01 * sphere.radius);
  const ConvexBody body(convex_hull(mesh.vertices, 1e-6).mesh);
  const OutsideDistance::Reach reach = solid.outside.reach(body);
  EXPECT_GE(reach.distance, 3 - 1e-4);
  EXPECT_LE(reach.distance, 3 + 2 * std::sqrt(3.0) * 0.01 * sphere.radius);
  EXPECT_NEAR(reach.where.x(), 6, 0.2);
  EXPECT_GT(reach.where.y(), 5.5);
  EXPECT_TRUE(solid.outside.within(body, reach.distance + 1e-6));
  EXPECT_FALSE(solid.outside.within(body, 2.99));
}

TEST(OutsideDistance, InsideIsZeroForClosedAndTheDistanceForOpen) {
  Solid cube(test::box(Point(-1, -1, -1), Point(1, 1, 1)), 0.01);
  const ConvexBody small(test::box(Point(-0.5, -0.5, -0.5), Point(0.5, 0.5, 0.5)));
  EXPECT_EQ(cube.outside.reach(small).distance, 0);
  EXPECT_TRUE(cube.outside.within(small, 1e-3));
  Mesh open = cube.mesh;
  open.faces.conservativeResize(10, 3);
  Solid shell(open, 0.01);
  EXPECT_FALSE(shell.outside.within(small, 0.4));
}

TEST(OutsideDistance, BodiesLargerThanTheBallOfTheSolid) {
  Solid solid(test::sphere(16, 32), 0.02);
  for (double size : {1.5, 3.0, 10.0}) {
    const ConvexBody body(test::box(-size * Point::Ones(), size * Point::Ones()));
    const double exact = std::sqrt(3.0) * size - 1;
    EXPECT_FALSE(solid.outside.within(body, 0.9 * exact)) << size;
    EXPECT_TRUE(solid.outside.within(body, 1.1 * exact + 2.1)) << size;
    const OutsideDistance::Reach reach = solid.outside.reach(body);
    EXPECT_GE(reach.distance, exact - 1e-6) << size;
    EXPECT_LE(reach.distance, exact + (size < 2 ? 0.1 : 2.1)) << size;
  }
}

TEST(OutsideDistance, AskingAgainAnswersAlike) {
  std::mt19937_64 random(3);
  const Mesh mesh = solids()[0];
  Solid first(mesh, 0.02), second(mesh, 0.02);
  std::vector<ConvexBody> bodies;
  for (int i = 0; i < 20; ++i)
    bodies.emplace_back(convex_hull((0.8 * test::cloud(test::Cloud::box, 6, random)).eval(), 1e-4).mesh);
  std::vector<double> reach;
  for (const ConvexBody& body : bodies) reach.push_back(first.outside.reach(body).distance);
  for (std::size_t i = bodies.size(); i-- > 0;) EXPECT_EQ(second.outside.reach(bodies[i]).distance, reach[i]);
}

}  // namespace
}  // namespace partwise
