#include "partwise/parts/surface/face_clustering.h"

#include <CGAL/mesh_segmentation.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "partwise/base/error.h"
#include "partwise/geometry/subdivide.h"
#include "partwise/geometry/test_shapes.h"
#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/face_values.h"
#include "partwise/parts/surface/shape_diameter.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

// The share of pairs of faces on which two labellings disagree, pair by pair.
double rand_error(const std::vector<int>& a, const std::vector<int>& b) {
  double different = 0, pairs = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < i; ++j, ++pairs) different += (a[i] == a[j]) != (b[i] == b[j]);
  return different / pairs;
}

std::vector<int> by_cgal(const Mesh& mesh, const Eigen::VectorXd& unit_values, int clusters, double lambda) {
  test::CgalMesh cgal = test::cgal_mesh(mesh);
  auto values = cgal.add_property_map<test::CgalMesh::Face_index, double>("f:sdf").first;
  auto segments = cgal.add_property_map<test::CgalMesh::Face_index, std::size_t>("f:segment").first;
  for (const auto face : cgal.faces()) values[face] = unit_values[face.idx()];
  CGAL::segmentation_from_sdf_values(cgal, values, segments, static_cast<std::size_t>(clusters), lambda);
  std::vector<int> labels(static_cast<std::size_t>(mesh.faces.rows()));
  for (const auto face : cgal.faces()) labels[face.idx()] = static_cast<int>(segments[face]);
  return labels;
}

Point middle(const Mesh& mesh, Eigen::Index face) {
  return mesh.vertices(mesh.faces.row(face), Eigen::all).colwise().mean();
}

TEST(FaceClustering, CutsADumbbellIntoTwoBallsAndARod) {
  const Mesh mesh = test::dumbbell(60, 40);
  const FaceClustering result = cluster_faces(mesh, shape_diameter(mesh).values, {.clusters = 2});
  EXPECT_EQ(result.segments, 3);
  std::vector<int> truth;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const double z = middle(mesh, f)[2], joint = 1.5 - std::sqrt(1 - 0.25 * 0.25);
    truth.push_back(std::abs(z) < joint ? 0 : z < 0 ? 1 : 2);
  }
  EXPECT_LT(rand_error(result.labels, truth), 0.03);
}

TEST(FaceClustering, AgreesWithCgalOnTheSameValues) {
  const Mesh shapes[] = {test::dumbbell(50, 30),
                         split_long_edges(test::box(Point(0, 0, 0), Point(4, 2, 1)), 0.4, 100000).mesh};
  for (const Mesh& mesh : shapes) {
    const Eigen::VectorXd values = normalised(shape_diameter(mesh).values);
    for (int clusters : {2, 3}) {
      const FaceClustering ours = cluster_faces(mesh, values, {.clusters = clusters, .smoothness = 26, .bend = 5});
      EXPECT_LT(rand_error(ours.labels, by_cgal(mesh, values, clusters, 0.26)), 0.05) << clusters;
    }
  }
}

TEST(FaceClustering, LinksWeighBendsAsDocumented) {
  // A flat square of two faces, bent up (inwards) and down (outwards) about its diagonal.
  Mesh mesh{Vertices(4, 3), Faces(2, 3)};
  mesh.faces << 0, 1, 2, 0, 2, 3;
  const auto weight = [&](double angle, const ClusteringSettings& settings) {
    mesh.vertices << 0, 0, 0, 1, -1, 0, 2, 0, 0, 1, std::cos(angle), std::sin(angle);
    const auto links = face_links(mesh, settings);
    EXPECT_EQ(links.size(), 1u);
    return links[0].weight;
  };
  for (double angle : {0.1, 0.5, 1.5, 3.0}) {
    EXPECT_NEAR(weight(angle, {}), -std::log(angle / std::numbers::pi), 1e-9);
    EXPECT_NEAR(weight(-angle, {}), -std::log(0.08 * angle / std::numbers::pi), 1e-9);
    EXPECT_NEAR(weight(-angle, {.convex_factor = 1}), weight(angle, {}), 1e-9);
  }
  EXPECT_NEAR(weight(0, {}), -std::log(5e-6), 1e-9);
}

TEST(FaceClustering, BordersAndFacesKeepTheirBalanceOnFinerMeshes) {
  // On a torus drawn with twice as many faces each way there are four times the faces, and twice the edges along a
  // border: each must cost twice as much.
  const ClusteringSettings sized{.clusters = 3, .by_length = true, .by_area = true};
  const auto mean_length = [&](const Mesh& mesh) {
    const auto plain = face_links(mesh, {}), by_length = face_links(mesh, sized);
    double sum = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) sum += by_length[i].weight / plain[i].weight;
    return sum / static_cast<double>(plain.size());
  };
  const Mesh mesh = test::torus(2, 0.7, 30, 16);
  EXPECT_NEAR(mean_length(test::torus(2, 0.7, 60, 32)) / mean_length(mesh), 2, 0.02);
  Mesh doubled = mesh;
  doubled.vertices *= 2;
  const Eigen::VectorXd values = face_means(mesh, mesh.vertices.col(0));
  EXPECT_EQ(cluster_faces(mesh, values, sized).labels, cluster_faces(doubled, values, sized).labels);
}

TEST(FaceClustering, SegmentsAreConnectedAndNumberedInOrder) {
  const Mesh mesh = test::torus(2, 0.7, 30, 16);
  std::srand(5);
  const Eigen::VectorXd values = Eigen::VectorXd::Random(mesh.faces.rows());
  const FaceClustering result = cluster_faces(mesh, values, {.clusters = 4, .smoothness = 0.1});
  ASSERT_GT(result.segments, 4);
  const FaceAdjacency adjacency = face_adjacency(mesh);
  EXPECT_EQ(label_pieces(adjacency, result.labels).label, result.labels);
  EXPECT_EQ(label_pieces(adjacency, result.labels).count, result.segments);
  int seen = 0;
  for (int label : result.labels) {
    EXPECT_LE(label, seen);
    seen = std::max(seen, label + 1);
  }
  EXPECT_EQ(seen, result.segments);
}

TEST(FaceClustering, SmallPiecesJoinTheNeighbourWithTheLongestBorder) {
  const Mesh mesh = test::torus(2, 0.7, 30, 16);
  std::srand(6);
  const Eigen::VectorXd values = Eigen::VectorXd::Random(mesh.faces.rows());
  const ClusteringSettings settings{.clusters = 3, .smoothness = 0.3, .least_area = 0.02};
  const FaceClustering result = cluster_faces(mesh, values, settings);
  const std::vector<double> areas = face_areas(mesh);
  std::vector<double> area(static_cast<std::size_t>(result.segments), 0.0);
  for (std::size_t f = 0; f < result.labels.size(); ++f) area[result.labels[f]] += areas[f];
  EXPECT_GE(*std::min_element(area.begin(), area.end()), 0.02 * std::accumulate(areas.begin(), areas.end(), 0.0));

  // Three bands of a strip, the middle one small, with its longer border on the left.
  Mesh strip{Vertices(5, 3), Faces(3, 3)};
  strip.vertices << 0, 0, 0, 0, 3, 0, 0.5, 0, 0, 1, 0.2, 0, 3, 3, 0;
  strip.faces << 0, 2, 1, 2, 3, 1, 3, 4, 1;
  const Components pieces{{0, 1, 2}, 3};
  const double left = std::hypot(0.5, 3), right = std::hypot(1, 2.8);
  ASSERT_GT(left, right);
  EXPECT_EQ(join_small_pieces(strip, pieces, 0.2).label, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(join_small_pieces(strip, pieces, 0).label, pieces.label);
}

TEST(FaceClustering, PutsUpWithAnyMesh) {
  // Two closed pieces, an open one, a face without area, and an edge of three faces.
  const Mesh ball = test::sphere(1, 10);
  Mesh mesh{Vertices(2 * ball.vertices.rows() + 5, 3), Faces(2 * ball.faces.rows() + 5, 3)};
  const auto n = static_cast<int>(ball.vertices.rows());
  mesh.vertices << ball.vertices, 0.5 * (ball.vertices.rowwise() + Point(9, 0, 0)), Eigen::MatrixXd::Zero(5, 3);
  mesh.vertices.bottomRows(5) << 9, 9, 0, 9, 10, 0, 10, 9, 0, 8, 9, 0, 9, 9, 1;
  mesh.faces.topRows(2 * ball.faces.rows()) << ball.faces, ball.faces.array() + n;
  const int b = 2 * n;
  mesh.faces.bottomRows(5) << b, b + 2, b + 1, b, b + 1, b + 3, b, b + 1, b + 4, b, b + 1, b + 1, b, b + 1, b;
  const Eigen::VectorXd values = shape_diameter(mesh).values;
  for (double least_area : {0.0, 0.2}) {
    const FaceClustering result = cluster_faces(mesh, values, {.clusters = 3, .least_area = least_area});
    EXPECT_GE(result.segments, 3);
    EXPECT_EQ(result.labels.size(), static_cast<std::size_t>(mesh.faces.rows()));
  }
  const FaceClustering constant = cluster_faces(mesh, Eigen::VectorXd::Ones(mesh.faces.rows()), {});
  EXPECT_EQ(constant.segments, label_pieces(face_adjacency(mesh), std::vector<int>(values.size(), 0)).count);
}

TEST(FaceClustering, SeveralFeaturesTellApartWhatOneCannot) {
  const Mesh mesh = test::torus(2, 0.7, 40, 16);
  Eigen::MatrixXd values(mesh.faces.rows(), 2);
  std::vector<int> quarter;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Point at = middle(mesh, f);
    values.row(f) << (at.x() > 0 ? 1 : 0), (at.y() > 0 ? 1 : 0);
    quarter.push_back((at.x() > 0 ? 1 : 0) + (at.y() > 0 ? 2 : 0));
  }
  EXPECT_LT(rand_error(cluster_faces(mesh, values, {.clusters = 4, .smoothness = 0.1}).labels, quarter), 0.01);
}

TEST(FaceClustering, SameSeedSameSegments) {
  const Mesh mesh = test::dumbbell(40, 30);
  const Eigen::VectorXd values = shape_diameter(mesh).values;
  EXPECT_EQ(cluster_faces(mesh, values, {.seed = 3}).labels, cluster_faces(mesh, values, {.seed = 3}).labels);
}

TEST(FaceClustering, RefusesWhatItCannotUse) {
  const Mesh mesh = test::sphere(1, 6);
  const Eigen::VectorXd values = Eigen::VectorXd::Ones(mesh.faces.rows());
  EXPECT_THROW(cluster_faces(mesh, Eigen::VectorXd::Ones(3)), InputError);
  EXPECT_THROW(cluster_faces(mesh, values * NAN), InputError);
  EXPECT_THROW(cluster_faces(mesh, values, {.clusters = 0}), InputError);
  EXPECT_THROW(cluster_faces(mesh, values, {.smoothness = -1}), InputError);
  EXPECT_THROW(cluster_faces(mesh, values, {.convex_factor = 0}), InputError);
}

}  // namespace
}  // namespace partwise
