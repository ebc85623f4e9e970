#include "partwise/parts/applications/cage.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/geometry/solid_angle.h"
#include "partwise/geometry/topology.h"
#include "partwise/geometry/triangle_crossing.h"
#include "partwise/parts/applications/cage_deformer.h"
#include "partwise/parts/applications/cage_moves.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

const Mesh& dumbbell_cage() {
  static const Mesh cage = make_cage(test::dumbbell()).mesh;
  return cage;
}

double largest_row(const Vertices& difference) { return difference.rowwise().norm().maxCoeff(); }

Eigen::Matrix3d some_rotation() {
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
}

// Winding numbers at all vertices, which make_cage does not look at, and what the header promises besides.
void expect_encloses(const Mesh& cage, const Mesh& mesh, int max_faces) {
  EXPECT_LE(cage.faces.rows(), max_faces);
  EXPECT_TRUE(is_watertight(cage));
  EXPECT_FALSE(crosses_itself(cage));
  for (const auto& vertex : mesh.vertices.rowwise()) ASSERT_NEAR(solid_angle_winding(cage, vertex), 1, 1e-9);
}

TEST(Cage, EnclosesShapesOfManyKinds) {
  for (const Mesh& mesh : {test::dumbbell(), test::l_shape(6, 2), test::u_shape(6, 1), test::torus(1, 0.2, 32, 12),
                           test::cup(1, 1.5, 0.1, 24), test::open_cup(1, 1.5, 24), test::sheet(6, 3),
                           test::joined(test::sphere(8, 12), test::moved(test::sphere(8, 12), Point(5, 0, 0)))}) {
    const Cage cage = make_cage(mesh);
    expect_encloses(cage.mesh, mesh, 300);
    EXPECT_GT(cage.volume, 0);
  }
}

TEST(Cage, FollowsTheParts) {
  // The hull of the U has the volume of its square; a cage that followed nothing would have more.
  const Mesh u = test::u_shape(12, 2);
  const double square = 12 * 12 * 2;
  EXPECT_LT(make_cage(u, {.expansion = 0.02}).volume, 0.75 * square);
  // The hole of a torus stays open: V - E + F = 0.
  const Mesh ring = make_cage(test::torus(1, 0.2, 32, 12)).mesh;
  EXPECT_EQ(ring.vertices.rows() - ring.faces.rows() / 2, 0);
}

TEST(Cage, HasFewFacesWhateverItTakes) {
  Mesh rings = test::torus(1, 0.05, 24, 6);
  for (int i = 1; i < 4; ++i)
    rings = test::joined(rings, test::moved(test::torus(1, 0.05, 24, 6), Point(0, 0, 0.4 * i)));
  for (const int most : {4, 12, 40, 300}) {
    const Cage cage = make_cage(rings, {.max_faces = most});
    expect_encloses(cage.mesh, rings, most);
  }
  EXPECT_THROW(make_cage(rings, {.max_faces = 3}), InputError);
  EXPECT_THROW(make_cage(rings, {.expansion = 0}), InputError);
}

TEST(CageDeformer, ACageThatStaysGivesBackThePoints) {
  const Mesh mesh = test::dumbbell();
  for (const CageCoordinates kind : {CageCoordinates::green, CageCoordinates::mean_value}) {
    const CageDeformer deformer(mesh.vertices, dumbbell_cage(), kind);
    EXPECT_LT(largest_row(deformer.deformed(dumbbell_cage().vertices) - mesh.vertices), 1e-12);
    EXPECT_LT((deformer.vertex_weights().rowwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  }
}

TEST(CageDeformer, MapsOfTheWholeCageAreReproduced) {
  const Mesh mesh = test::dumbbell();
  Eigen::Matrix3d affine;
  affine << 1.2, 0.4, 0, -0.1, 0.7, 0.3, 0.2, 0, 1.6;
  const Eigen::Matrix3d similar = 1.7 * some_rotation();
  const Point by(0.3, -2, 5);
  const auto error = [&](CageCoordinates kind, const Eigen::Matrix3d& map) {
    const auto mapped = [&](const Vertices& v) -> Vertices { return (v * map.transpose()).rowwise() + by; };
    const CageDeformer deformer(mesh.vertices, dumbbell_cage(), kind);
    return largest_row(deformer.deformed(mapped(dumbbell_cage().vertices)) - mapped(mesh.vertices));
  };
  EXPECT_LT(error(CageCoordinates::mean_value, affine), 1e-11);
  EXPECT_LT(error(CageCoordinates::mean_value, similar), 1e-11);
  EXPECT_LT(error(CageCoordinates::green, similar), 1e-11);
  EXPECT_GT(error(CageCoordinates::green, affine), 1e-2);  // as the header says
}

// By sums over small pieces of the faces: of 1 / r, and of each corner's hat times the derivative of 1 / r.
TEST(CageDeformer, GreenCoordinatesAreTheIntegralsThatDefineThem) {
  const Mesh tetrahedron =
      test::mesh_of({{0, 0, 0}, {2, 0, 0}, {0, 1.5, 0}, {0.2, 0.3, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  Vertices points(2, 3);
  points << 0.4, 0.35, 0.3, 0.7, 0.4, 0.15;
  const CageDeformer deformer(points, tetrahedron);
  constexpr int pieces = 400;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    Eigen::Vector4d of_vertex = Eigen::Vector4d::Zero();
    for (Eigen::Index f = 0; f < 4; ++f) {
      const Point a = tetrahedron.vertices.row(tetrahedron.faces(f, 0)),
                  u = tetrahedron.vertices.row(tetrahedron.faces(f, 1)) - a,
                  v = tetrahedron.vertices.row(tetrahedron.faces(f, 2)) - a;
      const Point normal = u.cross(v).normalized();
      const double piece = u.cross(v).norm() / 2 / (pieces * pieces) / (4 * std::numbers::pi);
      double of_face = 0;
      const auto add = [&](double s, double t) {
        const Point r = a + s * u + t * v - points.row(i);
        of_face += piece / r.norm();
        const double flux = piece * normal.dot(r) / std::pow(r.norm(), 3);
        of_vertex[tetrahedron.faces(f, 0)] += flux * (1 - s - t);
        of_vertex[tetrahedron.faces(f, 1)] += flux * s;
        of_vertex[tetrahedron.faces(f, 2)] += flux * t;
      };
      for (int j = 0; j < pieces; ++j)
        for (int k = 0; j + k < pieces; ++k) {
          add((j + 1 / 3.0) / pieces, (k + 1 / 3.0) / pieces);
          if (j + k + 1 < pieces) add((j + 2 / 3.0) / pieces, (k + 2 / 3.0) / pieces);
        }
      EXPECT_NEAR(deformer.face_weights()(i, f), of_face, 1e-5);
    }
    for (Eigen::Index v = 0; v < 4; ++v) EXPECT_NEAR(deformer.vertex_weights()(i, v), of_vertex[v], 1e-5);
  }
}

TEST(CageDeformer, RefusesWhatItCannotDo) {
  Vertices outside(1, 3);
  outside << 10, 0, 0;
  EXPECT_THROW(CageDeformer(outside, dumbbell_cage()), InputError);
  EXPECT_THROW(CageDeformer(dumbbell_cage().vertices.topRows(1), dumbbell_cage()), InputError);  // on the cage
  EXPECT_THROW(CageDeformer(Vertices::Zero(1, 3), test::open_cup(1, 1, 12)), InputError);
  const CageDeformer deformer(Vertices::Zero(1, 3), dumbbell_cage());
  EXPECT_THROW(deformer.deformed(Vertices::Zero(3, 3)), InputError);
}

TEST(CageDeformer, StopsWhenAsked) {
  const Progress stopped{{}, [] { return true; }};
  EXPECT_THROW(CageDeformer(Vertices::Zero(1, 3), dumbbell_cage(), CageCoordinates::green, stopped), Cancelled);
}

class CageMoves : public testing::Test {
 protected:
  Vertices read(const std::string& text) {
    const auto file = folder_.path() / "moves.json";
    std::ofstream(file) << text;
    return read_cage_moves(file, box_);
  }
  TestFolder folder_;
  const Mesh box_ = test::cells_mesh({{0, 0, 0}});
};

TEST_F(CageMoves, HandlesActInOrder) {
  EXPECT_EQ(read(R"({"handles": []})"), box_.vertices);
  const Vertices moved = read(R"({"handles": [{"all": true, "move": [1, 0, 0]},
      {"near": [0, 0, 0], "within": 0.1, "move": [0, 0, -1]},
      {"all": true, "scale": [2, 1, 1], "rotate": [0, 0, 2], "degrees": 90, "about": [0, 0, 0]}]})");
  for (Eigen::Index v = 0; v < 8; ++v) {
    const Point p = box_.vertices.row(v);
    const Point expected(-p.y(), 2 * (p.x() + 1), p.z() - (p.isZero() ? 1 : 0));
    EXPECT_LT((moved.row(v) - expected).norm(), 1e-14);
  }
  // About the middle of its own vertices, as they are by then.
  const Vertices shrunk = read(R"({"handles": [{"all": true, "move": [4, 0, 0]}, {"all": true, "scale": 0.5}]})");
  EXPECT_LT((shrunk.colwise().mean() - Point(4.5, 0.5, 0.5)).norm(), 1e-14);
  EXPECT_NEAR(shrunk.col(1).maxCoeff() - shrunk.col(1).minCoeff(), 0.5, 1e-14);
}

TEST_F(CageMoves, RefusesWhatIsNotSo) {
  for (const char* handle :
       {"7", "{}", R"({"vertices": []})", R"({"vertices": [8]})", R"({"vertices": [-1]})", R"({"vertices": [0.5]})",
        R"({"all": false})", R"({"all": true, "vertices": [0]})", R"({"near": [9, 9, 9], "within": 1})",
        R"({"near": [0, 0, 0]})", R"({"all": true, "move": [1, 2]})", R"({"all": true, "move": [1, 2, "x"]})",
        R"({"all": true, "rotate": [0, 0, 1]})", R"({"all": true, "rotate": [0, 0, 0], "degrees": 3})",
        R"({"all": true, "scale": 0})", R"({"all": true, "twist": 3})"}) {
    EXPECT_THROW(read("{\"handles\": [" + std::string(handle) + "]}"), InputError) << handle;
  }
  EXPECT_THROW(read("{"), InputError);
  EXPECT_THROW(read("{}"), InputError);
  EXPECT_THROW(read(R"({"handles": {}})"), InputError);
}

}  // namespace
}  // namespace partwise
