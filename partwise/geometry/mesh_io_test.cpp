#include "partwise/geometry/mesh_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include "partwise/base/error.h"
#include "partwise/geometry/topology.h"

namespace partwise {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class MeshIo : public testing::Test {
 protected:
  MeshIo() {
    folder_ = std::filesystem::path(testing::TempDir()) /
              fmt::format("partwise_mesh_io_{}", testing::UnitTest::GetInstance()->random_seed() + ::getpid());
    std::filesystem::create_directories(folder_);
  }
  ~MeshIo() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path text(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }

  std::filesystem::path folder_;
};

// Coordinates of every magnitude, with all their bits in use, and faces of any vertices.
Mesh random_mesh(int vertices, int faces, unsigned seed, double largest_exponent = 300) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1), exponent(-largest_exponent, largest_exponent);
  std::uniform_int_distribution<int> vertex(0, vertices - 1);
  Mesh mesh{Vertices(vertices, 3), Faces(faces, 3)};
  for (double& x : mesh.vertices.reshaped()) x = mantissa(random) * std::pow(10.0, exponent(random));
  for (int& v : mesh.faces.reshaped()) v = vertex(random);
  return mesh;
}

Mesh tetrahedron() {
  Mesh mesh{Vertices(4, 3), Faces(4, 3)};
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  mesh.faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return mesh;
}

TEST_F(MeshIo, OffObjAndPlyKeepEveryBitAndTheOrder) {
  Mesh mesh = random_mesh(500, 800, 1);
  mesh.vertices.row(0) << 0.0, -0.0, 5e-324;
  mesh.vertices.row(1) << 1.7976931348623157e308, -2.2250738585072014e-308, 0.1;
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.PLY"}) {
    SCOPED_TRACE(name);
    write_mesh(path(name), mesh);
    const Mesh back = read_mesh(path(name));
    EXPECT_EQ(back.faces, mesh.faces);
    ASSERT_EQ(back.vertices.rows(), mesh.vertices.rows());
    EXPECT_EQ(std::memcmp(back.vertices.data(), mesh.vertices.data(), sizeof(double) * mesh.vertices.size()), 0);
  }
}

TEST_F(MeshIo, StlAndGlbKeepTheFacesInSinglePrecision) {
  const Mesh mesh = random_mesh(300, 500, 2, 3);
  for (const char* name : {"a.stl", "a.glb"}) {
    SCOPED_TRACE(name);
    write_mesh(path(name), mesh);
    const Mesh back = read_mesh(path(name));
    ASSERT_EQ(back.faces.rows(), mesh.faces.rows());
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(back.vertices(back.faces(f, k), axis), static_cast<float>(mesh.vertices(mesh.faces(f, k), axis)));
    // Joined again: as many vertices as the faces use.
    std::vector<char> used(300, 0);
    for (const int v : mesh.faces.reshaped()) used[v] = 1;
    EXPECT_EQ(back.vertices.rows(), std::count(used.begin(), used.end(), 1));
  }
}

TEST_F(MeshIo, WritesTheSameBytesAgain) {
  const Mesh mesh = random_mesh(50, 80, 3, 3);
  const auto bytes = [&](const std::string& name) {
    write_mesh(path(name), mesh);
    std::ifstream file(path(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  for (const std::string ending : {".off", ".obj", ".ply", ".stl", ".glb"})
    EXPECT_EQ(bytes("a" + ending), bytes("b" + ending)) << ending;
}

TEST_F(MeshIo, SeveralMeshesAreReadAsOne) {
  Mesh second = tetrahedron();
  second.vertices.col(0).array() += 1;  // Touches the first: the two must not grow together.
  const std::vector<NamedMesh> both{{"first part", tetrahedron(), {1, 0, 0}},
                                    {"<second> & \"last\"", second, {0, 0, 1}}};
  for (const char* name : {"a.off", "a.obj", "a.ply", "a.glb"}) {
    SCOPED_TRACE(name);
    write_meshes(path(name), both);
    const Mesh mesh = read_mesh(path(name));
    EXPECT_EQ(mesh.vertices.rows(), 8);
    EXPECT_EQ(mesh.faces.rows(), 8);
    EXPECT_EQ(face_components_by_vertex(mesh).count, 2);
    EXPECT_DOUBLE_EQ(signed_volume(mesh), 1.0 / 3);
    EXPECT_TRUE(is_watertight(mesh));
  }
  std::ifstream obj(path("a.obj"));
  const std::string content(std::istreambuf_iterator<char>(obj), {});
  EXPECT_THAT(content, HasSubstr("o first_part\n"));
  EXPECT_THAT(content, HasSubstr("f 5 7 6\n"));
}

TEST_F(MeshIo, GltfTransformsAndMirrors) {
  // Two instances of a tetrahedron: twice as large about (1, 2, 3); mirrored in x and moved by 10 (1, 2, 3 also).
  const Mesh mesh = read_mesh(std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "corpus" / "nodes.glb");
  EXPECT_EQ(mesh.vertices.colwise().minCoeff(), Point(1, 2, 3));
  EXPECT_EQ(mesh.vertices.colwise().maxCoeff(), Point(10, 4, 5));
  EXPECT_TRUE(is_watertight(mesh));
  EXPECT_NEAR(signed_volume(mesh), 8.0 / 6 + 1.0 / 6, 1e-12);  // The mirror did not turn it inside out.
}

TEST_F(MeshIo, StripsAndFansTurnTheirTrianglesAlike) {
  const Mesh mesh = read_mesh(std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "corpus" / "strip_and_fan.glb");
  Faces wanted(4, 3);
  wanted << 0, 1, 2, 1, 3, 2, 0, 1, 2, 0, 2, 3;
  EXPECT_EQ(mesh.faces, wanted);
}

TEST_F(MeshIo, FailedWritesLeaveNothing) {
  Mesh mesh = tetrahedron();
  mesh.vertices(0, 0) = 1e39;
  EXPECT_THAT([&] { write_mesh(path("a.stl"), mesh); }, ThrowsMessage<InputError>(HasSubstr("single precision")));
  mesh.vertices(0, 0) = std::nan("");
  EXPECT_THAT([&] { write_mesh(path("a.off"), mesh); }, ThrowsMessage<InputError>(HasSubstr("not finite")));
  EXPECT_THAT([&] { write_mesh(path("a.gltf"), tetrahedron()); }, ThrowsMessage<InputError>(HasSubstr(".glb")));
  EXPECT_THAT([&] { write_mesh(path("no/a.off"), tetrahedron()); }, ThrowsMessage<InputError>(HasSubstr("written")));
  mesh = tetrahedron();
  mesh.faces(0, 0) = 4;
  EXPECT_THROW(write_mesh(path("a.stl"), mesh), CheckFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(MeshIo, MessagesNameTheLine) {
  const auto off = text("a.off", "OFF\n# a comment\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n\n3 0 1 3\n");
  EXPECT_THAT([&] { read_mesh(off); }, ThrowsMessage<InputError>(HasSubstr("a.off:8: face 0 names vertex 3")));
  const auto obj = text("a.obj", "v 0 0 0\nf 1 2 9\nv 0 0 1\nf 1 2 4\nv 1 0 0\n");
  EXPECT_THAT([&] { read_mesh(obj); }, ThrowsMessage<InputError>(HasSubstr("a.obj:2: a face names vertex 9")));
}

TEST_F(MeshIo, Labels) {
  const std::vector<int> labels{0, 3, 3, 1, 2147483647};
  write_labels(path("a.seg"), labels);
  EXPECT_EQ(read_labels(path("a.seg")), labels);
  EXPECT_EQ(read_labels(text("b.seg", "1\r\n\r\n2\r\n")), (std::vector{1, 2}));
  EXPECT_THAT([&] { read_labels(text("c.seg", "1\n2 3\n")); }, ThrowsMessage<InputError>(HasSubstr("c.seg:2: ")));
  EXPECT_THAT([&] { read_labels(text("d.seg", "1\n0.5\n")); }, ThrowsMessage<InputError>(HasSubstr("'0.5'")));
  EXPECT_THAT([&] { read_labels(text("e.seg", "\n")); }, ThrowsMessage<InputError>(HasSubstr("no labels")));
  EXPECT_THAT([&] { read_labels(text("f.seg", "9999999999")); }, ThrowsMessage<InputError>(HasSubstr("too large")));
}

}  // namespace
}  // namespace partwise
