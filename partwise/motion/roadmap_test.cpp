#include "partwise/motion/roadmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/polygon/segment_data.hpp>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <utility>
#include <vector>

#include "partwise/base/draw.h"
#include "partwise/motion/free_motion.h"
#include "partwise/motion/maprm.h"
#include "partwise/motion/margin_push.h"
#include "partwise/motion/point_scene.h"
#include "partwise/motion/test_scenes.h"

namespace partwise {
namespace {

// Rectangles of random sizes in the cells of a grid, corners at whole numbers, gaps from 2 on.
std::vector<std::array<int, 4>> random_rectangles(int side, std::uint64_t seed) {
  std::vector<std::array<int, 4>> result;
  Draw draw(seed, 0, 0);
  for (int i = 0; i < side * side; ++i) {
    const int x = 200 * (i % side), y = 200 * (i / side);
    result.push_back({x + draw.below(60), y + draw.below(60), x + 198 - draw.below(60), y + 198 - draw.below(60)});
  }
  return result;
}

struct Town {
  std::vector<std::array<int, 4>> rectangles;
  std::unique_ptr<Scene> scene;
  ContactSamples contacts;
};

Town town(int side, std::uint64_t seed) {
  Town result;
  result.rectangles = random_rectangles(side, seed);
  std::vector<Polygons> obstacles;
  std::vector<Ring> hulls;
  std::vector<int> numbers;
  for (const auto& [x0, y0, x1, y1] : result.rectangles) {
    numbers.push_back(static_cast<int>(obstacles.size()));
    obstacles.push_back(rectangle(x0, y0, x1, y1));
    hulls.push_back(obstacles.back()[0].outer);
  }
  const double end = 200.0 * side;
  result.scene = point_scene(obstacles, Eigen::AlignedBox2d(Eigen::Vector2d(0, 0), Eigen::Vector2d(end, end)));
  result.contacts = contact_samples(hulls, numbers, 200);
  return result;
}

using Integer = boost::polygon::point_data<int>;
using Segment = boost::polygon::segment_data<int>;
using Diagram = boost::polygon::voronoi_diagram<double>;

// The exact medial axis between different rectangles: edges of the Voronoi diagram of their sides, as points not
// farther apart than `spacing`. Curved ones run between a corner and a side.
std::vector<Eigen::Vector2d> voronoi_points(const std::vector<std::array<int, 4>>& rectangles, double spacing) {
  std::vector<Segment> sides;
  for (const auto& [x0, y0, x1, y1] : rectangles) {
    const std::array<Integer, 4> corners = {Integer(x0, y0), Integer(x1, y0), Integer(x1, y1), Integer(x0, y1)};
    for (std::size_t k = 0; k < 4; ++k) sides.emplace_back(corners[k], corners[(k + 1) % 4]);
  }
  Diagram diagram;
  boost::polygon::construct_voronoi(sides.begin(), sides.end(), &diagram);
  std::vector<Eigen::Vector2d> points;
  for (const auto& edge : diagram.edges()) {
    const std::size_t a = edge.cell()->source_index() / 4, b = edge.twin()->cell()->source_index() / 4;
    if (a == b || edge.is_infinite() || edge.twin() < &edge) continue;
    const Eigen::Vector2d from(edge.vertex0()->x(), edge.vertex0()->y()), to(edge.vertex1()->x(), edge.vertex1()->y());
    const int pieces = static_cast<int>(std::ceil((to - from).norm() / spacing));
    if (edge.is_linear()) {
      for (int k = 0; k <= pieces; ++k) points.push_back(from + (to - from) * k / std::max(pieces, 1));
      continue;
    }
    // A parabola: over the side, at each place as high as it is far from the corner.
    const auto* cell = edge.cell()->contains_point() ? edge.cell() : edge.twin()->cell();
    const auto* other = edge.cell()->contains_point() ? edge.twin()->cell() : edge.cell();
    const Segment& own = sides[cell->source_index()];
    const Integer c =
        cell->source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT ? own.low() : own.high();
    const bool starts =
        (c == own.low()) == (cell->source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT);
    const Integer corner = starts ? c : (c == own.low() ? own.high() : own.low());
    const Segment& side = sides[other->source_index()];
    const Eigen::Vector2d p(corner.x(), corner.y()), s(side.low().x(), side.low().y()),
        t(side.high().x(), side.high().y());
    const Eigen::Vector2d along = (t - s).normalized(), up(-along.y(), along.x());
    const double height = (p - s).dot(up), foot = (p - s).dot(along);
    const double u0 = (from - s).dot(along), u1 = (to - s).dot(along);
    for (int k = 0; k <= pieces; ++k) {
      const double u = u0 + (u1 - u0) * k / std::max(pieces, 1), off = u - foot;
      points.push_back(s + u * along + (off * off + height * height) / (2 * height) * up);
    }
  }
  return points;
}

double nearest(const std::vector<Eigen::Vector2d>& points, const Configuration& q) {
  double best = 1e300;
  for (const Eigen::Vector2d& each : points) best = std::min(best, (each - Eigen::Vector2d(q.head<2>())).norm());
  return best;
}

// Of each method: the share of samples within 1 % of the mean clearance of the exact medial axis.
double accuracy(const AxisSamples& found, const std::vector<Eigen::Vector2d>& axis) {
  double mean = 0;
  for (const AxisSample& each : found.samples)
    mean += each.state.clearance() / static_cast<double>(found.samples.size());
  int close = 0;
  for (const AxisSample& each : found.samples) close += nearest(axis, each.q) <= 0.01 * mean;
  return close / static_cast<double>(found.samples.size());
}

TEST(AxisSamples, LieOnTheExactMedialAxis) {
  const Town place = town(5, 1);
  const MarginField field(place.scene->space(), place.contacts);
  const std::vector<Eigen::Vector2d> axis = voronoi_points(place.rectangles, 0.1);
  ASSERT_GT(axis.size(), 50000u);
  const AxisSamples ours = axis_samples(*place.scene, MarginPush(*place.scene, field), {.count = 400});
  ASSERT_EQ(ours.samples.size(), 400u);
  EXPECT_GE(accuracy(ours, axis), 0.99);
  EXPECT_LT(ours.lost, ours.drawn / 4);
  const AxisSamples exact =
      axis_samples(*place.scene, Maprm(*place.scene, {.exact = true}), {.count = 400, .only_on_axis = false});
  EXPECT_GE(accuracy(exact, axis), 0.9);
  const AxisSamples rays =
      axis_samples(*place.scene, Maprm(*place.scene, {.resolution = 2}), {.count = 100, .only_on_axis = false});
  EXPECT_LT(accuracy(rays, axis), accuracy(ours, axis));
}

// Samples reach all of the axis between the rectangles; outside of them it runs away from all.
TEST(AxisSamples, CoverTheMedialAxis) {
  const Town place = town(4, 2);
  const MarginField field(place.scene->space(), place.contacts);
  const AxisSamples found = axis_samples(*place.scene, MarginPush(*place.scene, field), {.count = 3000});
  int covered = 0, inside = 0;
  for (const Eigen::Vector2d& each : voronoi_points(place.rectangles, 3)) {
    if (each.minCoeff() < 100 || each.maxCoeff() > 700) continue;
    ++inside;
    double best = 1e300;
    for (const AxisSample& sample : found.samples)
      best = std::min(best, (Eigen::Vector2d(sample.q.head<2>()) - each).norm());
    covered += best < 10;
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(covered, 0.97 * inside);
}

TEST(FreeMotion, IsDecidedByDistances) {
  const auto scene = point_scene(std::vector<Polygons>{rectangle(0, 0, 10, 10), rectangle(10.001, 0, 20, 10)},
                                 Eigen::AlignedBox2d(Eigen::Vector2d(-20, -20), Eigen::Vector2d(40, 40)));
  const auto asked = [&](double x0, double y0, double x1, double y1) {
    const Configuration a{{x0, y0}}, b{{x1, y1}};
    return free_motion(*scene, a, clearance(*scene, a), b, clearance(*scene, b), 1e-5);
  };
  EXPECT_TRUE(asked(-5, -5, -5, 15).free);
  EXPECT_FALSE(asked(-5, 5, 25, 5).free);
  EXPECT_FALSE(asked(-1, 9.9999, 11, 9.9999).free);  // only just
  EXPECT_TRUE(asked(-1, 10.001, 21, 10.001).free);
  EXPECT_TRUE(asked(10.0005, -5, 10.0005, 15).free);  // through the gap
  EXPECT_FALSE(asked(10.0005, -5, 10.0205, 15).free);
  EXPECT_EQ(asked(-5, -5, -5.5, -5).distance_queries, 0);
  EXPECT_FALSE(asked(5, 5, -5, 5).free);  // starts inside
}

TEST(Roadmap, HasFreeEdgesAlongTheAxis) {
  const Town place = town(5, 3);
  const MarginField field(place.scene->space(), place.contacts);
  const MarginPush push(*place.scene, field);
  const AxisSamples found = axis_samples(*place.scene, push, {.count = 600});
  const auto least_clearance = [&](const Roadmap& roadmap) {
    double sum = 0;
    for (const RoadmapEdge& each : roadmap.edges) {
      EXPECT_LT(each.from, each.to);
      std::vector<Configuration> stops = {found.samples[static_cast<std::size_t>(each.from)].q};
      stops.insert(stops.end(), each.between.begin(), each.between.end());
      stops.push_back(found.samples[static_cast<std::size_t>(each.to)].q);
      double least = 1e300;
      for (std::size_t i = 1; i < stops.size(); ++i) {
        for (int k = 0; k <= 50; ++k) {
          const Configuration q = place.scene->space().between(stops[i - 1], stops[i], k / 50.0);
          EXPECT_TRUE(place.scene->free(q));
          least = std::min(least, clearance(*place.scene, q));
        }
      }
      sum += least;
    }
    return sum / static_cast<double>(roadmap.edges.size());
  };
  const Roadmap pushed = connected(*place.scene, found.samples, push);
  const Roadmap straight = connected(*place.scene, found.samples, push, {.push = false});
  EXPECT_GT(pushed.edges.size(), 1200u);
  EXPECT_GE(pushed.edges.size(), straight.edges.size());
  EXPECT_LE(pushed.components, straight.components);
  EXPECT_GT(least_clearance(pushed), least_clearance(straight));
}

// Joined are the same samples, by fewer edges; about a path through all of them none stays left out.
TEST(Roadmap, WithoutCyclesAnEdgeIsLeftOutUntilAPathPasses) {
  const Town here = town(3, 7);
  const MarginField field(here.scene->space(), here.contacts);
  const MarginPush push(*here.scene, field);
  const std::vector<AxisSample> samples = axis_samples(*here.scene, push, {.count = 300}).samples;
  const Roadmap whole = connected(*here.scene, samples, push);
  GrowingRoadmap growing(*here.scene, push, {.cycles = false});
  const int end = growing.add_endpoint(samples[0].q);
  for (std::size_t i = 0; i < samples.size(); i += 50) growing.add({samples.begin() + i, samples.begin() + i + 50});
  EXPECT_EQ(growing.roadmap().components, whole.components);
  EXPECT_LT(2 * growing.roadmap().edges.size(), whole.edges.size());

  MotionPath path;
  for (const AxisSample& each : growing.samples()) path.configurations.push_back(each.q);
  const auto numbers = [&] {
    std::vector<std::pair<int, int>> pairs;
    for (const RoadmapEdge& each : growing.roadmap().edges) pairs.emplace_back(each.from, each.to);
    return pairs;
  };
  growing.add_cycles(path);
  const auto joined = numbers();
  EXPECT_GT(joined.size(), 9 * whole.edges.size() / 10);
  EXPECT_TRUE(std::ranges::is_sorted(joined));
  EXPECT_EQ(std::ranges::adjacent_find(joined), joined.end());  // each pair once, those of the endpoint too
  EXPECT_TRUE(std::ranges::any_of(joined, [&](const auto& pair) { return pair.first == end; }));
  growing.add_cycles(path);
  EXPECT_EQ(numbers(), joined);
}

}  // namespace
}  // namespace partwise
