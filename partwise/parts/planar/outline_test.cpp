#include "partwise/parts/planar/outline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include "partwise/base/error.h"
#include "partwise/geometry/orientation.h"
#include "partwise/geometry/polygon_validity.h"
#include "partwise/parts/planar/hierarchical_concavity.h"
#include "partwise/parts/planar/segmentation_measures.h"
#include "partwise/parts/planar/skeleton.h"

namespace partwise {
namespace {

Ring ring(const std::vector<Point2>& corners) {
  Ring result(static_cast<Eigen::Index>(corners.size()), 2);
  for (std::size_t i = 0; i < corners.size(); ++i) result.row(static_cast<Eigen::Index>(i)) = corners[i].transpose();
  return result;
}

// A star-shaped ring with bumps at random.
Ring blob(std::mt19937_64& random, const Point2& centre, double radius, int corners) {
  std::uniform_real_distribution<double> bump(0.35, 1);
  std::vector<Point2> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    points.push_back(centre + radius * bump(random) * Point2(std::cos(angle), std::sin(angle)));
  }
  return ring(points);
}

// Brute force by definition: every corner of the outer ring against the hull edge over it.
double depth_by_definition(const Polygon& part) {
  const Ring& outer = part.outer;
  const auto n = outer.rows();
  const auto at = [&](Eigen::Index i) -> Point2 { return outer.row(i % n).transpose(); };
  const auto on_hull = [&](Eigen::Index i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (j == i) continue;
      bool supports = true;
      for (Eigen::Index k = 0; k < n && supports; ++k) supports = orientation(at(i), at(j), at(k)) >= 0;
      if (supports) return true;
      supports = true;
      for (Eigen::Index k = 0; k < n && supports; ++k) supports = orientation(at(i), at(j), at(k)) <= 0;
      if (supports) return true;
    }
    return false;
  };
  std::vector<Eigen::Index> hull;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (on_hull(i)) hull.push_back(i);
  }
  double depth = 0;
  for (std::size_t h = 0; h < hull.size(); ++h) {
    const Eigen::Index from = hull[h], to = h + 1 < hull.size() ? hull[h + 1] : hull[0] + n;
    for (Eigen::Index i = from; i <= to; ++i) depth = std::max(depth, distance_to_segment(at(i), at(from), at(to)));
  }
  for (const Ring& hole : part.holes) {
    Point2 a, b;
    double farthest = -1;
    for (Eigen::Index i = 0; i < hole.rows(); ++i) {
      for (Eigen::Index j = 0; j < i; ++j) {
        if ((hole.row(i) - hole.row(j)).norm() > farthest) {
          farthest = (hole.row(i) - hole.row(j)).norm(), a = hole.row(i), b = hole.row(j);
        }
      }
    }
    for (Eigen::Index i = 0; i < hole.rows(); ++i) {
      depth = std::max(depth, distance_to_segment(hole.row(i).transpose(), a, b));
    }
  }
  return depth;
}

void expect_decomposition(const Polygons& shape, const Outline& outline, double tolerance) {
  EXPECT_NEAR(area(outline.parts) / area(shape), 1, 1e-12);
  for (const Polygon& part : outline.parts) {
    EXPECT_FALSE(find_fault(Polygons{part}));
    EXPECT_LE(depth_by_definition(part), tolerance * (1 + 1e-12));
  }
  // Every side of a part is a side of the shape or, the other way round, of exactly one other part.
  std::map<std::array<double, 4>, int> sides;
  const auto each = [&](const Polygons& polygons, const auto& visit) {
    for (const Polygon& polygon : polygons) {
      std::vector<Ring> rings = polygon.holes;
      rings.push_back(polygon.outer);
      for (const Ring& r : rings) {
        for (Eigen::Index i = 0, j = r.rows() - 1; i < r.rows(); j = i++) visit(r(j, 0), r(j, 1), r(i, 0), r(i, 1));
      }
    }
  };
  each(shape, [&](double ax, double ay, double bx, double by) { ++sides[{bx, by, ax, ay}]; });
  each(outline.parts, [&](double ax, double ay, double bx, double by) { ++sides[{ax, ay, bx, by}]; });
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_TRUE(sides.contains({side[2], side[3], side[0], side[1]}));
  }
}

TEST(DecomposeOutline, RandomBlobsWithHolesTileWithinTolerance) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 60; ++round) {
    Polygons shape{{blob(random, {0, 0}, 10, 12 + round), {}}};
    if (round % 2) shape[0].holes.push_back(blob(random, {0, 0}, 3, 5 + round % 9));
    if (round % 3 == 0) shape.push_back({blob(random, {30, 5}, 8, 20), {blob(random, {30, 5}, 0.3, 6)}});
    normalise(shape);
    ASSERT_FALSE(find_fault(shape));
    for (double tolerance : {0.02, 0.1, 0.4}) {
      const Outline outline = decompose_outline(shape, {.tolerance = tolerance});
      expect_decomposition(shape, outline, tolerance * outline.radius);
      EXPECT_LE(outline.concavity, tolerance);
    }
  }
}

TEST(DecomposeOutline, KnownShapes) {
  const Ring cross_shape = ring(
      {{-1, -3}, {1, -3}, {1, -1}, {3, -1}, {3, 1}, {1, 1}, {1, 3}, {-1, 3}, {-1, 1}, {-3, 1}, {-3, -1}, {-1, -1}});
  EXPECT_EQ(decompose_outline(Polygons{{cross_shape, {}}}, {.tolerance = 0.1}).parts.size(), 3u);
  const Ring l_shape = ring({{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}});
  EXPECT_EQ(decompose_outline(Polygons{{l_shape, {}}}, {.tolerance = 0.1}).parts.size(), 2u);
  EXPECT_EQ(decompose_outline(Polygons{{l_shape, {}}}, {.tolerance = 2.2, .absolute = true}).parts.size(), 1u);
}

TEST(DecomposeOutline, HolesAreNoiseOrStructure) {
  Polygons shape{{ring({{0, 0}, {20, 0}, {20, 20}, {0, 20}}),
                  {ring({{3, 3}, {3, 3.4}, {3.4, 3.4}, {3.4, 3}}), ring({{8, 8}, {8, 14}, {14, 14}, {14, 8}})}}};
  const Outline outline = decompose_outline(shape, {.tolerance = 0.05});
  EXPECT_EQ(outline.holes_noise(), 1);
  EXPECT_EQ(outline.holes_kept(), 1);
  EXPECT_TRUE(outline.holes[0].noise);
  expect_decomposition(shape, outline, 0.05 * outline.radius);
  EXPECT_EQ(outline.parts.size(), 4u);  // a frame
}

// Cuts do not feel holes that are noise: they pass as if these were filled.
TEST(DecomposeOutline, CutsPassThroughNoise) {
  const Polygons clean{
      {ring({{0, 0}, {10, 0}, {10, 8}, {7, 10}, {10, 12}, {10, 20}, {0, 20}, {0, 12}, {3, 10}, {0, 8}}), {}}};
  Polygons noisy = clean;
  noisy[0].holes.push_back(ring({{4.9, 9.9}, {4.9, 10.1}, {5.1, 10.1}, {5.1, 9.9}}));  // in the way of the cut
  const Outline a = decompose_outline(clean, {.tolerance = 0.1}), b = decompose_outline(noisy, {.tolerance = 0.1});
  EXPECT_EQ(a.parts.size(), 2u);
  EXPECT_EQ(b.parts.size(), 2u);
  EXPECT_EQ(b.cuts.size(), 2u);  // up to the hole, and on from it
  expect_decomposition(noisy, b, 0.1 * b.radius);
  const auto grid = [](const Outline& o) { return label_grid(o.parts, {0, 0}, {10, 20}); };
  EXPECT_GT(rand_index(grid(a), grid(b)), 0.99);
}

TEST(DecomposeOutline, Refusals) {
  const Polygons square{{ring({{0, 0}, {1, 0}, {1, 1}}), {}}};
  EXPECT_THROW(decompose_outline(square, {.tolerance = 0}), InputError);
  EXPECT_THROW(decompose_outline(square, {.tolerance = std::nan("")}), InputError);
  EXPECT_THROW(decompose_outline({}, {}), InputError);
}

TEST(Skeleton, OfACrossIsAStarOfItsArms) {
  const Ring shape = ring(
      {{-1, -5}, {1, -5}, {1, -1}, {5, -1}, {5, 1}, {1, 1}, {1, 5}, {-1, 5}, {-1, 1}, {-5, 1}, {-5, -1}, {-1, -1}});
  const Outline outline = decompose_outline(Polygons{{shape, {}}}, {.tolerance = 0.1});
  const Skeleton skeleton = extract_skeleton(outline);
  // A tree: one edge less than nodes, all within the shape's box.
  EXPECT_EQ(skeleton.edges.size() + 1, skeleton.nodes.size());
  const auto tips = std::count_if(skeleton.nodes.begin(), skeleton.nodes.end(),
                                  [](const SkeletonNode& node) { return node.kind == SkeletonNodeKind::tip; });
  EXPECT_EQ(tips, static_cast<long>(outline.parts.size()) - 1);
}

TEST(SegmentationMeasures, ClosedForms) {
  const Polygons whole{{ring({{0, 0}, {4, 0}, {4, 4}, {0, 4}}), {}}};
  const Polygons halves{{ring({{0, 0}, {2, 0}, {2, 4}, {0, 4}}), {}}, {ring({{2, 0}, {4, 0}, {4, 4}, {2, 4}}), {}}};
  const Polygons others{{ring({{0, 0}, {4, 0}, {4, 2}, {0, 2}}), {}}, {ring({{0, 2}, {4, 2}, {4, 4}, {0, 4}}), {}}};
  const auto grid = [](const Polygons& p) { return label_grid(p, {0, 0}, {4, 4}, 20); };
  EXPECT_DOUBLE_EQ(rand_index(grid(whole), grid(whole)), 1);
  EXPECT_DOUBLE_EQ(rand_index(grid(halves), grid(halves)), 1);
  // n = 400 cells in two halves: together in both are 2 C(200, 2) of C(400, 2) pairs.
  EXPECT_DOUBLE_EQ(rand_index(grid(whole), grid(halves)), 2.0 * (200 * 199 / 2) / (400 * 399 / 2));
  const double quarters = 4.0 * (100 * 99 / 2) + 2 * 100 * 100;  // together in both, or apart in both
  EXPECT_DOUBLE_EQ(rand_index(grid(halves), grid(others)), quarters / (400 * 399 / 2));

  const std::vector<CutLine> vertical = cut_lines(halves), horizontal = cut_lines(others);
  ASSERT_EQ(vertical.size(), 1u);
  EXPECT_EQ(vertical[0], CutLine(2, 0, 2, 4));
  const std::vector<std::vector<CutLine>> people{vertical, vertical, vertical, horizontal};
  const auto clusters = cluster_cuts(people, 0);
  ASSERT_EQ(clusters.size(), 1u);  // one cut each on average
  EXPECT_EQ(clusters[0].members, 4);
  EXPECT_DOUBLE_EQ(cluster_coverage(vertical, clusters, 0.1), 1);
  EXPECT_DOUBLE_EQ(cluster_coverage({}, clusters, 0.1), 0);
  const LabelGrid divided =
      representative_grid(grid(whole), cluster_cuts(std::vector<std::vector<CutLine>>{vertical}, 0));
  EXPECT_DOUBLE_EQ(rand_index(divided, grid(halves)), 1);
}

// Counted over all pairs, as the formula has it.
TEST(SegmentationMeasures, RandIndexByBruteForce) {
  std::mt19937_64 random(9);
  LabelGrid a, b;
  a.size = b.size = 9;
  for (int i = 0; i < 81; ++i) {
    a.labels.push_back(static_cast<int>(random() % 5) - 1);
    b.labels.push_back(static_cast<int>(random() % 4) - 1);
  }
  double agree = 0, all = 0;
  for (int i = 0; i < 81; ++i) {
    for (int j = 0; j < i; ++j) {
      if (a.labels[i] < 0 || b.labels[i] < 0 || a.labels[j] < 0 || b.labels[j] < 0) continue;
      ++all;
      agree += (a.labels[i] == a.labels[j]) == (b.labels[i] == b.labels[j]) ? 1 : 0;
    }
  }
  EXPECT_NEAR(rand_index(a, b), agree / all, 1e-12);
}

}  // namespace
}  // namespace partwise
