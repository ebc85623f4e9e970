#include "partwise/parts/solid/part_merging.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

using test::block;

SpaceSamples samples_of(const Mesh& mesh) {
  return sample_space(SurfaceQuery(mesh), convex_hull(mesh.vertices, 1e-6).mesh, 2000);
}

// A piece a slab of cells along an axis.
std::vector<HullPart> slabs(const Mesh& mesh, int axis) {
  std::map<int, std::vector<int>> by_slab;
  for (int f = 0; f < mesh.faces.rows(); ++f) {
    const Point centre = mesh.vertices(mesh.faces.row(f), Eigen::all).colwise().mean();
    by_slab[static_cast<int>(std::floor(centre[axis] - 1e-6))].push_back(f);
  }
  std::vector<HullPart> parts;
  for (auto& [key, faces] : by_slab) parts.push_back(hull_part(mesh, faces, 1e-4));
  return parts;
}

std::vector<int> faces_of(const std::vector<HullPart>& parts) {
  std::vector<int> faces;
  for (const HullPart& part : parts) {
    EXPECT_TRUE(std::is_sorted(part.faces.begin(), part.faces.end()));
    faces.insert(faces.end(), part.faces.begin(), part.faces.end());
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

// Accepts hulls that hold at most this much more than the solid's cells in them.
AcceptMerge little_air(const SpaceSamples& space, double most) {
  return [&space, most](const HullPart& merged) {
    return static_cast<double>(space.air.inside(merged.hull).size()) * space.volume <= most;
  };
}

TEST(PartMerging, TwoBoxesInARowBecomeOne) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {2, 1, 1}));
  const SpaceSamples space = samples_of(mesh);
  PartMerging merging(mesh, space, slabs(mesh, 0), little_air(space, 0.05), {});
  merging.merge({});
  const std::vector<HullPart> parts = merging.parts();
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].faces, test::all_faces(mesh));
  EXPECT_NEAR(parts[0].volume, 2, 1e-4);  // Flat pieces at the ends were given a thickness.
}

TEST(PartMerging, TheArmsOfAnLDoNot) {
  const Mesh mesh = test::l_shape(6, 2);
  const SpaceSamples space = samples_of(mesh);
  PartMerging merging(mesh, space, slabs(mesh, 0), little_air(space, 1), {});
  merging.merge({});
  const std::vector<HullPart> parts = merging.parts();
  EXPECT_EQ(parts.size(), 2u);
  EXPECT_EQ(faces_of(parts), test::all_faces(mesh));
}

TEST(PartMerging, StopsAtTheNumberAskedFor) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {9, 1, 1}));
  const SpaceSamples space = samples_of(mesh);
  for (int most = 1; most < 9; ++most) {
    PartMerging merging(mesh, space, slabs(mesh, 0), [](auto&&...) { return true; }, {});
    merging.merge({}, most);
    EXPECT_EQ(merging.parts().size(), static_cast<std::size_t>(most));
    EXPECT_EQ(faces_of(merging.parts()), test::all_faces(mesh));
  }
}

TEST(PartMerging, WhatIsRefusedOrTakesTooMuchAirStaysApart) {
  const Mesh mesh = test::l_shape(6, 2);
  const SpaceSamples space = samples_of(mesh);
  int asked = 0;
  PartMerging never(mesh, space, slabs(mesh, 0), [&](auto&&...) { return ++asked, false; }, {});
  never.merge({});
  EXPECT_EQ(never.dissolve({}), 0);
  EXPECT_EQ(never.parts().size(), slabs(mesh, 0).size());
  EXPECT_LT(asked, 40);  // No pair is asked about twice.
  PartMerging tight(mesh, space, slabs(mesh, 0), [](auto&&...) { return true; }, {.largest_air = 1});
  tight.merge({});
  EXPECT_EQ(tight.parts().size(), 2u);
}

TEST(PartMerging, SeparateBodiesMergeOnlyWhenConnected) {
  Mesh mesh = test::cells_mesh(block({0, 0, 0}, {1, 1, 1}));
  for (int i = 1; i < 12; ++i)
    mesh = test::joined(mesh, test::moved(test::cells_mesh(block({0, 0, 0}, {1, 1, 1})), Point(3 * i, i % 2, 0)));
  const SpaceSamples space = samples_of(mesh);
  PartMerging merging(mesh, space, slabs(mesh, 0), [](auto&&...) { return true; }, {});
  merging.merge({});
  EXPECT_EQ(merging.parts().size(), 12u);
  merging.connect_all();
  merging.merge({}, 2);
  EXPECT_EQ(merging.parts().size(), 2u);
  merging.merge({});
  EXPECT_EQ(merging.parts().size(), 1u);
  EXPECT_EQ(faces_of(merging.parts()), test::all_faces(mesh));
}

// The middle of three boxes, whose halves go to either side.
TEST(PartMerging, DissolvesWhatItsNeighboursCanTake) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {4, 1, 1}));
  const SpaceSamples space = samples_of(mesh);
  const AcceptMerge half = [](const HullPart& merged) { return merged.volume < 2.1; };
  PartMerging merging(mesh, space, slabs(mesh, 0), half, {});
  merging.merge({});
  const std::size_t before = merging.parts().size();
  const int gone = merging.dissolve({});
  EXPECT_EQ(merging.parts().size(), before - static_cast<std::size_t>(gone));
  EXPECT_EQ(merging.parts().size(), 2u);
  EXPECT_EQ(faces_of(merging.parts()), test::all_faces(mesh));
  for (const HullPart& part : merging.parts()) {
    EXPECT_NEAR(part.volume, 2, 1e-4);
    EXPECT_LE(test::largest_excess(part.hull, corners_of(mesh, part.faces)), 1e-12);
  }
}

// The middle of three pieces of length 2 fits in neither neighbour; its halves do.
TEST(PartMerging, HalvedPiecesFitWhereWholeOnesDoNot) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {6, 1, 1}));
  std::vector<std::vector<int>> thirds(3);
  for (int f = 0; f < mesh.faces.rows(); ++f) {
    const double x = corners_of(mesh, {f}).col(0).mean();
    thirds[static_cast<std::size_t>(std::min(2, static_cast<int>(x / 2)))].push_back(f);
  }
  std::vector<HullPart> pieces;
  for (auto& faces : thirds) pieces.push_back(hull_part(mesh, std::move(faces), 1e-4));
  const SpaceSamples space = samples_of(mesh);
  const AcceptMerge at_most_three = [](const HullPart& merged) { return merged.volume < 3.1; };
  PartMerging merging(mesh, space, std::move(pieces), at_most_three, {});
  merging.merge({});
  EXPECT_EQ(merging.dissolve({}), 0);
  ASSERT_EQ(merging.parts().size(), 3u);
  merging.refine();
  EXPECT_EQ(merging.parts().size(), 3u);
  EXPECT_EQ(merging.dissolve({}), 1);
  ASSERT_EQ(merging.parts().size(), 2u);
  EXPECT_EQ(faces_of(merging.parts()), test::all_faces(mesh));
  for (const HullPart& part : merging.parts()) EXPECT_NEAR(part.volume, 3, 1e-4);
}

// A thickened hull stands for its points as they were: hulls made of hulls stay exact.
TEST(HullPart, ThickenedHullsAreMadeAnewFromTheirPoints) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {2, 2, 2}));
  std::vector<int> bottom, rest;
  for (int f = 0; f < mesh.faces.rows(); ++f)
    (corners_of(mesh, {f}).col(2).maxCoeff() == 0 ? bottom : rest).push_back(f);
  const HullPart plate = hull_part(mesh, bottom, 0.1);
  ASSERT_TRUE(plate.thickened);
  EXPECT_NEAR(plate.volume, 4 * 0.1, 1e-12);
  const Corners corners = exact_corners(mesh, plate);
  EXPECT_EQ(corners.points.col(2).cwiseAbs().maxCoeff(), 0);
  HullPart both;
  Corners all = corners;
  const HullPart open = hull_part(mesh, rest, 0.1);
  all.append(open.hull.vertices, open.source);
  set_hull(both, all, 0.1);
  EXPECT_FALSE(both.thickened);
  EXPECT_NEAR(both.volume, 8, 1e-12);
  for (std::size_t v = 0; v < both.source.size(); ++v)
    EXPECT_EQ(both.hull.vertices.row(static_cast<Eigen::Index>(v)), mesh.vertices.row(both.source[v]));
}

TEST(HullPart, CornersOfFacesAndExtremePoints) {
  const Mesh mesh = test::cells_mesh(block({0, 0, 0}, {3, 3, 3}));
  const HullPart part = hull_part(mesh, test::all_faces(mesh), 1e-4);
  EXPECT_NEAR(part.volume, 27, 1e-12);
  EXPECT_EQ(corners_of(mesh, {0}).rows(), 3);
  std::mt19937_64 random(1);
  const Vertices cloud = test::cloud(test::Cloud::sphere, 3000, random), few = extreme_points(cloud);
  EXPECT_LE(few.rows(), 96);
  EXPECT_GT(convex_hull(few, 1e-9).volume, 0.85 * convex_hull(cloud, 1e-9).volume);
  EXPECT_EQ(extreme_points(cloud.topRows(96)), cloud.topRows(96));
}

// A flat part holds the second face in its thickness; the face is the part's, and has to stay in when the part grows.
TEST(HullPart, ExactCornersAreThoseOfAllFacesOfAFlatPart) {
  Mesh mesh{Vertices(6, 3), Faces(2, 3)};
  mesh.vertices << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 0.5, -0.03, 0.5, 1, -0.03, 1, 1, -0.03;
  mesh.faces << 0, 1, 2, 3, 4, 5;
  HullPart part = hull_part(mesh, {0}, 0.1);
  ASSERT_TRUE(part.thickened);
  part.faces = {0, 1};
  EXPECT_EQ(exact_corners(mesh, part).source, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(exact_corners(mesh, part).points, mesh.vertices);
}

TEST(SpaceSamples, CountsApproximateVolumes) {
  const Mesh mesh = test::l_shape(6, 2);  // 20 squares, 2 deep; its hull 28 squares
  const SurfaceQuery surface(mesh);
  const Mesh hull = convex_hull(mesh.vertices, 1e-6).mesh;
  const SpaceSamples space = sample_space(surface, hull, 4000);
  EXPECT_NEAR(static_cast<double>(space.solid.size()) * space.volume, 40, 1);
  EXPECT_NEAR(static_cast<double>(space.air.size()) * space.volume, signed_volume(hull) - 40, 1);
  EXPECT_NEAR(static_cast<double>(space.air.size() + space.solid.size()), 4000, 100);
  for (const auto& p : space.solid.points().rowwise()) EXPECT_TRUE(p.x() <= 2 || p.y() <= 2);
  for (const auto& p : space.air.points().rowwise()) EXPECT_FALSE(p.x() < 2 || p.y() < 2);
  EXPECT_EQ(space.solid.inside(hull).size(), static_cast<std::size_t>(space.solid.size()));
}

TEST(SpaceSamples, AHoleBlursTheSolidAndASheetHasNone) {
  const Mesh mesh = test::l_shape(6, 2);
  const Mesh hull = convex_hull(mesh.vertices, 1e-6).mesh;
  const Mesh open{mesh.vertices, mesh.faces.topRows(mesh.faces.rows() - 1)};
  const SpaceSamples space = sample_space(SurfaceQuery(open), hull, 4000);
  EXPECT_NEAR(static_cast<double>(space.solid.size()) * space.volume, 40, 6);
  const Mesh sheet{mesh.vertices, mesh.faces.topRows(1)};
  EXPECT_EQ(sample_space(SurfaceQuery(sheet), hull, 100).solid.size(), 0);
}

}  // namespace
}  // namespace partwise
