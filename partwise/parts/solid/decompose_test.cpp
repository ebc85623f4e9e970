#include "partwise/parts/solid/decompose.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "partwise/geometry/convex_hull.h"
#include "partwise/geometry/topology.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

using test::block;
using test::cells_mesh;

bool closed_and_convex(const Mesh& hull, double slack) {
  if (!is_watertight(hull) || !(signed_volume(hull) > 0)) return false;
  const auto planes = hull_planes(hull);
  for (const auto& plane : planes.rowwise())
    if ((hull.vertices * plane.head<3>().transpose()).maxCoeff() - plane[3] > slack) return false;
  return true;
}

// How far points of the hull lie outside the solid: a lower bound of what is promised, by exact distances.
double sampled_reach(const Mesh& hull, const SurfaceQuery& surface, bool closed, std::mt19937_64& random) {
  std::exponential_distribution<double> weight;
  double reach = 0;
  for (int i = 0; i < 300; ++i) {
    Point p = Point::Zero();
    double sum = 0;
    const bool on_face = i % 2;
    const auto face =
        hull.faces.row(static_cast<Eigen::Index>(random() % static_cast<std::uint64_t>(hull.faces.rows())));
    for (int k = 0; k < (on_face ? 3 : 5); ++k) {
      const double w = weight(random);
      sum += w;
      p += w * hull.vertices.row(
                   on_face ? face[k] : static_cast<int>(random() % static_cast<std::uint64_t>(hull.vertices.rows())));
    }
    p /= sum;
    if (!closed || !surface.contains(p)) reach = std::max(reach, surface.distance(p));
  }
  return reach;
}

// All that decompose() promises whatever the input; returns the result.
Decomposition checked(const Mesh& mesh, const DecompositionSettings& settings = {}, bool needles = false) {
  const Decomposition d = decompose(mesh, settings);
  const double unit = settings.absolute ? 1 : d.radius, size = d.radius + 1e-4 * mesh.vertices.cwiseAbs().maxCoeff();
  EXPECT_GT(d.parts(), 0);
  EXPECT_EQ(d.labels.size(), static_cast<std::size_t>(mesh.faces.rows()));
  EXPECT_EQ(d.mesh_labels.size(), static_cast<std::size_t>(d.mesh.faces.rows()));
  if (!d.cut_inside) {
    EXPECT_EQ(d.mesh.faces, mesh.faces);
    EXPECT_EQ(d.labels, d.mesh_labels);
  }
  for (int label : d.labels) EXPECT_TRUE(label >= 0 && label < d.parts());

  int next = 0;  // Labels are numbered by their first face.
  std::vector<std::vector<int>> faces(d.hulls.size());
  for (std::size_t f = 0; f < d.mesh_labels.size(); ++f) {
    const int label = d.mesh_labels[f];
    if (label < 0 || label >= d.parts()) {
      ADD_FAILURE() << "label " << label;
      return d;
    }
    EXPECT_LE(label, next);
    next = std::max(next, label + 1);
    faces[label].push_back(static_cast<int>(f));
  }
  EXPECT_EQ(next, d.parts());

  for (std::size_t p = 0; p < d.hulls.size(); ++p) {
    const Mesh part{d.mesh.vertices, Faces(d.mesh.faces(faces[p], Eigen::all))};
    if (settings.max_hulls == 0) {
      EXPECT_EQ(face_components_by_vertex(part).count, 1) << "part " << p;
    }
    EXPECT_TRUE(closed_and_convex(d.hulls[p], 1e-9 * size)) << "hull " << p;
    const auto planes = hull_planes(d.hulls[p]);
    double outside = -1;
    for (const auto& f : part.faces.rowwise())
      for (int v : f)
        outside =
            std::max(outside, (planes.leftCols<3>() * part.vertices.row(v).transpose() - planes.col(3)).maxCoeff());
    EXPECT_LE(outside, 1e-9 * size) << "hull " << p;
    if (settings.max_hull_vertices > 0) {
      EXPECT_LE(d.hulls[p].vertices.rows(), settings.max_hull_vertices);
    }
  }

  if (settings.max_hulls > 0) {
    EXPECT_LE(d.parts(), settings.max_hulls);
  }
  if (settings.cup_repair && settings.max_hulls == 0) {
    EXPECT_LE(d.concavity, d.tolerance);
  }
  if (settings.measure == ConcavityMeasure::hull) {
    // Cubes near a needle's tip cannot be told from its inside: its bound is loose, and only samples are held to it.
    const bool promised = settings.max_hulls == 0 && settings.max_hull_vertices == 0;
    if (promised && !needles) {
      EXPECT_LE(d.concavity, d.tolerance);
    }
    std::mt19937_64 random(1);
    const Mesh oriented = orient_consistently(mesh);
    const SurfaceQuery surface(oriented);
    for (const Mesh& hull : d.hulls) {
      const double reach = sampled_reach(hull, surface, d.watertight, random);
      EXPECT_LE(reach, d.concavity * unit + 1e-5 * size);
      if (promised) {
        EXPECT_LE(reach, d.tolerance * unit + 1e-5 * size);
      }
    }
  }
  if (d.watertight && std::abs(signed_volume(mesh)) > 1e-9 * std::pow(d.radius, 3)) {
    EXPECT_GT(d.volume_ratio, 0);
  }
  return d;
}

TEST(Decompose, ConvexBodiesStayWhole) {
  for (const Mesh& mesh :
       {cells_mesh(block({0, 0, 0}, {1, 1, 1})), cells_mesh(block({0, 0, 0}, {9, 2, 3})), test::sphere(12, 24)}) {
    const Decomposition d = checked(mesh);
    EXPECT_EQ(d.parts(), 1);
    EXPECT_TRUE(d.watertight);
    EXPECT_NEAR(d.volume_ratio, 1, 0.002);
    EXPECT_EQ(checked(mesh, {.measure = ConcavityMeasure::valley}).parts(), 1);
  }
}

TEST(Decompose, CoarseLIsTwoBoxesOrTwoMitredBars) {
  const Decomposition d = checked(test::coarse_l());
  EXPECT_EQ(d.parts(), 2);
  EXPECT_LT(d.volume_ratio, 1.1);
  EXPECT_LT(d.concavity, 0.03);
}

// A cube with a pyramid's pit in its top: no part of whole faces is convex enough.
TEST(Decompose, CoarseFacesAreCutInside) {
  Mesh mesh = cells_mesh(block({0, 0, 0}, {1, 1, 1}));
  std::vector<Point> vertices;
  for (const auto& v : mesh.vertices.rowwise()) vertices.emplace_back(2 * v);
  vertices.emplace_back(1, 1, 0.2);
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 2>> rim;
  for (const auto& f : mesh.faces.rowwise()) {
    const std::array<int, 3> face{f[0], f[1], f[2]};
    if (vertices[f[0]].z() + vertices[f[1]].z() + vertices[f[2]].z() < 6) {
      faces.push_back(face);
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const Point along = vertices[face[(k + 1) % 3]] - vertices[face[k]];
      if (along.norm() < 2.5) rim.push_back({face[k], face[(k + 1) % 3]});
    }
  }
  for (const auto& [a, b] : rim) faces.push_back({a, b, 8});
  mesh = test::mesh_of(vertices, faces);
  ASSERT_EQ(mesh.faces.rows(), 14);
  const Decomposition d = checked(mesh);
  EXPECT_TRUE(d.watertight);
  EXPECT_TRUE(d.cut_inside);
  EXPECT_LE(d.parts(), 10);
}

TEST(Decompose, SimpleShapesTakeAsManyPartsAsTheyHaveArms) {
  EXPECT_EQ(checked(test::l_shape(12, 4)).parts(), 2);
  const Decomposition u = checked(test::u_shape(12, 3));
  EXPECT_EQ(u.parts(), 3);
  EXPECT_LT(u.volume_ratio, 1.1);
  auto table = block({0, 0, 8}, {10, 10, 10});
  for (int x : {0, 8})
    for (int y : {0, 8}) table = test::united(table, block({x, y, 0}, {x + 2, y + 2, 8}));
  const Decomposition d = checked(cells_mesh(table));
  EXPECT_GE(d.parts(), 5);
  EXPECT_LE(d.parts(), 6);
  const Decomposition ring = checked(test::torus(1, 0.3, 48, 24));
  EXPECT_GE(ring.parts(), 4);
  EXPECT_LE(ring.parts(), 10);
  EXPECT_TRUE(ring.watertight);
}

TEST(Decompose, TheValleyMeasureCutsArmsToo) {
  const DecompositionSettings valley{.measure = ConcavityMeasure::valley};
  for (const Mesh& mesh : {test::l_shape(12, 4), test::u_shape(12, 3), test::dumbbell()}) {
    const Decomposition d = checked(mesh, valley);
    EXPECT_GE(d.parts(), 2);
    EXPECT_LE(d.parts(), 5);
    EXPECT_LE(d.concavity, d.tolerance);
  }
}

TEST(Decompose, CupsAreCutWithTheRepair) {
  const Mesh cup = test::cup(1, 1.5, 0.1, 48);
  const Decomposition whole = checked(cup, {.measure = ConcavityMeasure::valley});
  EXPECT_EQ(whole.parts(), 1);
  EXPECT_GT(whole.volume_ratio, 3);
  const Decomposition d = checked(cup, {.measure = ConcavityMeasure::valley, .cup_repair = true});
  EXPECT_GE(d.parts(), 5);
  EXPECT_LE(d.parts(), 40);
  EXPECT_LT(d.volume_ratio, 1.6);
  EXPECT_LE(d.concavity, d.tolerance);
}

TEST(Decompose, OpenCupsAreCutWithTheRepairEitherWayRound) {
  Mesh cup = test::open_cup(1, 1.5, 48);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(checked(cup, {.measure = ConcavityMeasure::valley}).parts(), 1);
    const Decomposition d = checked(cup, {.measure = ConcavityMeasure::valley, .cup_repair = true});
    EXPECT_GE(d.parts(), 5);
    EXPECT_LE(d.concavity, d.tolerance);
    cup.faces.col(0).swap(cup.faces.col(1));
  }
}

TEST(Decompose, TheRepairLeavesConvexBodiesWhole) {
  for (const Mesh& mesh : {cells_mesh(block({0, 0, 0}, {9, 2, 3})), test::sphere(12, 24)})
    EXPECT_EQ(checked(mesh, {.measure = ConcavityMeasure::valley, .cup_repair = true}).parts(), 1);
}

TEST(Decompose, SeparateBodiesStaySeparate) {
  const Mesh boxes = test::joined(cells_mesh(block({0, 0, 0}, {2, 2, 2})),
                                  test::moved(cells_mesh(block({0, 0, 0}, {2, 2, 2})), Point(3, 0, 0)));
  const Decomposition d = checked(boxes);
  EXPECT_EQ(d.parts(), 2);
  EXPECT_NEAR(d.volume_ratio, 1, 0.002);
  const Decomposition one = checked(boxes, {.max_hulls = 1});
  EXPECT_EQ(one.parts(), 1);
  EXPECT_GT(one.concavity, one.tolerance);
}

TEST(Decompose, OpenMeshes) {
  const Mesh triangle = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Decomposition d = checked(triangle);
  EXPECT_EQ(d.parts(), 1);
  EXPECT_FALSE(d.watertight);
  EXPECT_TRUE(std::isnan(d.volume_ratio));
  EXPECT_EQ(checked(test::sheet(1, 1)).parts(), 1);
  EXPECT_EQ(checked(test::sheet(8, 8)).parts(), 1);
  EXPECT_EQ(checked(test::sheet(8, 4)).parts(), 2);
}

TEST(Decompose, ThreePagesAtOneEdge) {
  checked(test::mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
}

TEST(Decompose, RepeatedFaces) {
  checked(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 2}, {0, 2, 1}, {0, 1, 3}}));
}

TEST(Decompose, VerticesOfNoFaceDoNotCount) {
  checked(test::mesh_of({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-50, 0, 0}}, {{1, 2, 3}}));
}

TEST(Decompose, FacesWithoutAreaAreInParts) {
  checked(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 0, 1}, {2, 2, 2}}));
}

TEST(Decompose, ASquareCoveredFromBothSidesIsClosedWithoutVolume) {
  EXPECT_EQ(
      checked(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 2, 1}, {0, 3, 2}}))
          .parts(),
      1);
}

TEST(Decompose, CubesThatShareAnEdge) { checked(cells_mesh({{0, 0, 0}, {1, 1, 0}})); }

TEST(Decompose, LimitsOnHullsAndTheirVertices) {
  for (const Mesh& mesh : {test::u_shape(8, 2), test::sphere(8, 12)})
    for (int vertices : {0, 8, 60})
      for (int hulls : {0, 1, 2}) {
        if (hulls == 0 && mesh.faces.rows() < 200) continue;  // SimplifiedHullsOfASphereKeepTheTolerance
        if (hulls == 0 && vertices == 0) continue;
        SCOPED_TRACE(fmt::format("{} faces, {} vertices, {} hulls", mesh.faces.rows(), vertices, hulls));
        const Decomposition d = checked(mesh, {.max_hulls = hulls, .max_hull_vertices = vertices});
        if (hulls == 0 && vertices >= 8) {
          EXPECT_LE(d.concavity, d.tolerance);
        }
      }
}

// Open: hulls are delivered from the input's vertices, simplified anew, and not as they were when the promise was
// tested.
TEST(Decompose, SimplifiedHullsOfASphereKeepTheTolerance) {
  for (int vertices : {8, 60}) EXPECT_LE(checked(test::sphere(12, 24), {.max_hull_vertices = vertices}).concavity, 0.1);
}

TEST(Decompose, ATightTetrahedronReachesFarOutsideItsBall) {
  // A regular one about the unit sphere has its corners at distance 3.
  const Decomposition d = checked(test::sphere(16, 32), {.tolerance = 5, .max_hull_vertices = 4});
  EXPECT_EQ(d.parts(), 1);
  EXPECT_GT(d.concavity, 1.9);
  EXPECT_LT(d.concavity, 5);
}

TEST(Decompose, FineTolerancesOnCoarseMeshes) {
  for (double tolerance : {0.05, 0.03}) {
    const Decomposition d = checked(test::coarse_l(), {.tolerance = tolerance});
    EXPECT_LE(d.parts(), 20);
  }
}

TEST(Decompose, LargeTolerancesKeepEverythingWhole) {
  for (double tolerance : {1.0, 3.0, 1000.0})
    EXPECT_EQ(checked(test::u_shape(12, 3), {.tolerance = tolerance}).parts(), 1);
}

TEST(Decompose, ScaleAndPlaceDoNotMatter) {
  const Mesh mesh = test::u_shape(12, 3);
  const Decomposition d = checked(mesh);
  Mesh large = mesh;
  large.vertices *= 1024;  // exact
  const Decomposition scaled = checked(large);
  EXPECT_EQ(d.labels, scaled.labels);
  EXPECT_NEAR(d.concavity, scaled.concavity, 1e-9);
  EXPECT_DOUBLE_EQ(1024 * d.radius, scaled.radius);

  const Decomposition far = checked(test::moved(mesh, Point(1e5, -1e5, 1e5)));
  EXPECT_EQ(d.labels, far.labels);
  EXPECT_NEAR(d.concavity, far.concavity, 1e-6);

  const Decomposition absolute = checked(large, {.tolerance = 0.1 * scaled.radius, .absolute = true});
  EXPECT_EQ(d.labels, absolute.labels);
  EXPECT_DOUBLE_EQ(absolute.tolerance, 0.1 * scaled.radius);
  EXPECT_NEAR(absolute.concavity, scaled.concavity * scaled.radius, 1e-9 * scaled.radius);
}

TEST(Decompose, SameBytesForAnyNumberOfThreads) {
  for (const ConcavityMeasure measure : {ConcavityMeasure::hull, ConcavityMeasure::valley}) {
    std::vector<Decomposition> results;
    for (std::size_t threads : {1, 2, 2}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      results.push_back(decompose(test::torus(1, 0.3, 40, 16), {.measure = measure, .max_hull_vertices = 20}));
    }
    for (const Decomposition& d : results) {
      EXPECT_EQ(d.labels, results[0].labels);
      EXPECT_EQ(d.concavity, results[0].concavity);
      EXPECT_EQ(d.volume_ratio, results[0].volume_ratio);
      ASSERT_EQ(d.parts(), results[0].parts());
      for (int p = 0; p < d.parts(); ++p) {
        EXPECT_EQ(d.hulls[p].vertices, results[0].hulls[p].vertices);
        EXPECT_EQ(d.hulls[p].faces, results[0].hulls[p].faces);
      }
    }
  }
}

TEST(Decompose, BadSettingsAndMeshesAreInputErrors) {
  const Mesh mesh = test::coarse_l();
  const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (double tolerance : {0.0, -1.0, 1e-9, infinity, nan})
    EXPECT_THROW(decompose(mesh, {.tolerance = tolerance}), InputError);
  EXPECT_THROW(decompose(mesh, {.tolerance = 1e-9, .absolute = true}), InputError);
  EXPECT_THROW(decompose(mesh, {.cup_repair = true}), InputError);
  EXPECT_THROW(decompose(mesh, {.max_hulls = -1}), InputError);
  EXPECT_THROW(decompose(mesh, {.max_hull_vertices = -1}), InputError);
  EXPECT_THROW(decompose(mesh, {.max_hull_vertices = 3}), InputError);
  EXPECT_THROW(decompose(Mesh{}), InputError);
  EXPECT_THROW(decompose(Mesh{mesh.vertices, Faces(0, 3)}), InputError);
  EXPECT_THROW(decompose(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}})), InputError);
  EXPECT_THROW(decompose(test::mesh_of({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}})), InputError);
  for (double bad : {infinity, nan}) {
    for (int v = 0; v < 12; ++v) {
      Mesh broken = mesh;
      broken.vertices(v, v % 3) = bad;
      EXPECT_THROW(decompose(broken), InputError) << v;
    }
  }
}

TEST(Decompose, StopsWhenAsked) {
  int calls = 0;
  const Progress progress{.report = {}, .cancelled = [&] { return ++calls > 3; }};
  EXPECT_THROW(decompose(test::torus(1, 0.3, 40, 16), {}, progress), Cancelled);
}

TEST(Decompose, ProgressStaysWithinBounds) {
  const Progress progress{.report =
                              [](std::string_view, double done) {
                                EXPECT_GE(done, 0);
                                EXPECT_LE(done, 1);
                              },
                          .cancelled = {}};
  decompose(test::u_shape(8, 2), {}, progress);
}

// Time must not grow with the square of the number of parts.
TEST(Decompose, TwentyThousandSeparateTriangles) {
  Mesh mesh{Vertices(60000, 3), Faces(20000, 3)};
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(-0.3, 0.3);
  for (int i = 0; i < 60000; ++i) {
    const int t = i / 3;
    mesh.vertices.row(i) = Point(t % 27, t / 27 % 27, t / 729) + Point(side(random), side(random), side(random));
    mesh.faces(t, i % 3) = i;
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(decompose(mesh).parts(), 20000);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 120);
}

// Whatever triangles: either an InputError or all the promises.
TEST(Decompose, RandomSoups) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> side(-1, 1);
    const int vertices = 3 + static_cast<int>(random() % 8), faces = 1 + static_cast<int>(random() % 12);
    Mesh mesh{Vertices(vertices, 3), Faces(faces, 3)};
    for (double& x : mesh.vertices.reshaped()) x = random() % 4 ? side(random) : std::round(2 * side(random)) / 2;
    for (int& v : mesh.faces.reshaped()) v = static_cast<int>(random() % static_cast<unsigned>(vertices));
    if (seed % 5 == 1) mesh.vertices.col(2).setZero();
    if (seed % 5 == 2) mesh.vertices.col(0) *= 1e-7;
    if (seed % 7 == 3) mesh.vertices *= 1e6;
    DecompositionSettings settings{.tolerance = 0.15 + 0.1 * static_cast<double>(random() % 4)};
    settings.measure = seed % 3 == 0 ? ConcavityMeasure::valley : ConcavityMeasure::hull;
    settings.cup_repair = seed % 6 == 0;
    if (seed % 4 == 1) settings.max_hulls = 1 + static_cast<int>(random() % 3);
    if (seed % 4 == 2) settings.max_hull_vertices = 4 + static_cast<int>(random() % 6);
    try {
      checked(mesh, settings, true);
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace partwise
