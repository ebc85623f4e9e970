#include "partwise/parts/surface/part_retrieval.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/geometry/mesh_io.h"
#include "partwise/parts/surface/part_database.h"
#include "partwise/parts/surface/segmentation.h"
#include "partwise/parts/surface/surface_centricity.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

namespace fs = std::filesystem;

// The best of all ways to match the nodes of two paths, by trying.
double best_sum(const PartHierarchy& a, const std::vector<int>& path_a, const PartHierarchy& b, std::vector<int> path_b,
                std::size_t next = 0) {
  if (next == path_a.size()) return 0;
  double best = best_sum(a, path_a, b, path_b, next + 1);
  for (std::size_t k = 0; k < path_b.size(); ++k) {
    std::vector<int> rest = path_b;
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
    const double weight = histogram_similarity(a.histograms.row(path_a[next]), b.histograms.row(path_b[k]));
    best = std::max(best, weight + best_sum(a, path_a, b, rest, next + 1));
  }
  return best;
}

PartIndex drawn_index(int parts, unsigned seed) {
  std::srand(seed);
  PartIndex index;
  index.hierarchy.parts = parts;
  for (int k = 0; k < parts; ++k) index.hierarchy.parents.push_back(k < parts / 2 ? parts : parts + 1);
  index.hierarchy.parents.insert(index.hierarchy.parents.end(), {parts + 1, -1});
  index.hierarchy.histograms = Eigen::MatrixXd::Random(parts + 2, 6).cwiseAbs();
  for (int k = 0; k < parts; ++k) index.labels.insert(index.labels.end(), static_cast<std::size_t>(k + 1), k);
  return index;
}

TEST(PartRetrieval, HistogramsByCommonOverJointArea) {
  const Eigen::RowVector3d a(0.2, 0.1, 0), b(0.1, 0.3, 0.1);
  EXPECT_NEAR(histogram_similarity(a, b), 0.2 / 0.6, 1e-12);
  EXPECT_EQ(histogram_similarity(a, a), 1);
  EXPECT_EQ(histogram_similarity(a, Eigen::RowVector3d::Zero()), 0);
  EXPECT_EQ(histogram_similarity(Eigen::RowVector3d::Zero(), Eigen::RowVector3d::Zero()), 1);
}

TEST(PartRetrieval, ScoreIsTheBestMatchingOfThePaths) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PartHierarchy a = drawn_index(4, seed).hierarchy, b = drawn_index(5, seed + 100).hierarchy;
    for (int p = 0; p < a.parts; ++p) {
      for (int q = 0; q < b.parts; ++q) {
        const auto path_a = a.root_path(p), path_b = b.root_path(q);
        const double mean_length = static_cast<double>(path_a.size() + path_b.size()) / 2;
        EXPECT_NEAR(part_similarity(a, p, b, q), best_sum(a, path_a, b, path_b) / mean_length, 1e-12);
        EXPECT_NEAR(part_similarity(a, p, b, q), part_similarity(b, q, a, p), 1e-12);
      }
    }
  }
}

TEST(PartRetrieval, BestFirstAndThePartItselfIsFirst) {
  std::vector<PartIndex> indices;
  for (unsigned seed = 1; seed < 6; ++seed) indices.push_back(drawn_index(6, seed));
  std::vector<const PartIndex*> all;
  for (const PartIndex& index : indices) all.push_back(&index);
  const std::vector<PartMatch> matches = similar_parts(indices[3], 2, all, 100);
  ASSERT_EQ(matches.size(), 30u);
  EXPECT_EQ(matches[0].mesh, 3);
  EXPECT_EQ(matches[0].part, 2);
  EXPECT_EQ(matches[0].similarity, 1);
  for (std::size_t i = 1; i < matches.size(); ++i) {
    EXPECT_LT(matches[i].similarity, matches[i - 1].similarity);
    EXPECT_NEAR(matches[i].similarity,
                part_similarity(indices[3].hierarchy, 2, all[matches[i].mesh]->hierarchy, matches[i].part), 1e-15);
  }
  EXPECT_EQ(similar_parts(indices[3], 2, all, 4).size(), 4u);
}

TEST(PartRetrieval, SaysWhichPartsThereAre) {
  const PartIndex index = drawn_index(3, 1);
  try {
    similar_parts(index, 3, {&index}, 9);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::ContainsRegex("no part 3; .*0 \\(.*%\\), 1 \\(.*%\\), 2 \\(.*%\\)"));
  }
  EXPECT_THROW(similar_parts(index, -1, {&index}, 9), InputError);
}

TEST(PartRetrieval, NeitherScaleNorTurnMattersToAlikeParts) {
  // A peanut: curved everywhere, so that few lines of sight graze the surface, which turning may decide otherwise. The
  // parts may differ by a face or two where a mesh was turned, so all have those of the first.
  const auto height = [](double t) { return -2 * std::cos(std::numbers::pi * t); };
  const auto radius = [&](double t) {
    const double z = height(t);
    return std::sqrt(std::max(0.0, 1 - z * z / 4)) * (0.3 + 0.4 * z * z);
  };
  const Mesh mesh = test::revolved(radius, height, 40, 24);
  const PartIndex index = index_parts(mesh);
  EXPECT_EQ(index.labels, segment(mesh).labels);
  const auto worst_similarity = [&](const Mesh& moved) {
    const PartHierarchy other =
        part_hierarchy(moved, index.labels,
                       {feature_values(moved, SurfaceFeature::visibility_average).col(0),
                        feature_values(moved, SurfaceFeature::shape_diameter).col(0), surface_centricity(moved)});
    double worst = 1;
    for (int part = 0; part < other.parts; ++part)
      worst = std::min(worst, part_similarity(index.hierarchy, part, other, part));
    return worst;
  };
  Mesh moved = mesh;
  moved.vertices *= 0.125;  // exact
  EXPECT_NEAR(worst_similarity(moved), 1, 1e-12);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(3, 2, 1).normalized()).toRotationMatrix();
  moved.vertices = ((0.01 * mesh.vertices * turn.transpose()).rowwise() + Eigen::RowVector3d(1, 2, 3)).eval();
  // Many faces are equally large, so that rounding decides which are samples of the centricity.
  EXPECT_GT(worst_similarity(moved), 0.95);
}

class PartDatabaseTest : public testing::Test {
 protected:
  PartDatabaseTest() {
    write_mesh(folder_.path() / "ball.off", test::sphere(1, 8));
    fs::create_directory(folder_.path() / "more");
    write_mesh(folder_.path() / "more" / "dumbbell.off", test::dumbbell(16, 10));
    std::ofstream(folder_.path() / "notes.txt") << "no mesh";
  }

  fs::path index_of(const fs::path& file) const {
    return folder_.path() / ".partwise" / (file.string() + ".parts.json");
  }

  TestFolder folder_;
};

TEST_F(PartDatabaseTest, IndexesOnceAndAgainWhatChanged) {
  const PartDatabase first = open_part_database(folder_.path());
  ASSERT_EQ(first.meshes.size(), 2u);
  EXPECT_EQ(first.indexed, 2);
  EXPECT_EQ(first.meshes[0].file, "ball.off");
  EXPECT_EQ(first.meshes[1].file, fs::path("more") / "dumbbell.off");
  EXPECT_TRUE(fs::exists(index_of("ball.off")));
  EXPECT_TRUE(fs::exists(index_of("more/dumbbell.off")));

  const PartDatabase second = open_part_database(folder_.path());
  EXPECT_EQ(second.indexed, 0);
  for (int k = 0; k < 2; ++k) {  // to the bit
    EXPECT_EQ(second.meshes[k].index.labels, first.meshes[k].index.labels);
    EXPECT_EQ(second.meshes[k].index.hierarchy.parents, first.meshes[k].index.hierarchy.parents);
    EXPECT_EQ(second.meshes[k].index.hierarchy.histograms, first.meshes[k].index.hierarchy.histograms);
  }
  EXPECT_EQ(second.find(first.meshes[1].content), &second.meshes[1]);
  EXPECT_EQ(second.find(first.meshes[1].content + 1), nullptr);

  write_mesh(folder_.path() / "ball.off", test::sphere(1, 10));
  const PartDatabase third = open_part_database(folder_.path());
  EXPECT_EQ(third.indexed, 1);
  EXPECT_NE(third.meshes[0].content, first.meshes[0].content);
  EXPECT_GT(third.meshes[0].index.labels.size(), first.meshes[0].index.labels.size());
  EXPECT_EQ(open_part_database(folder_.path()).indexed, 0);
}

TEST_F(PartDatabaseTest, ADamagedOrOldIndexIsMadeAnew) {
  const PartDatabase first = open_part_database(folder_.path());
  std::ifstream stream(index_of("ball.off"));
  const std::string good{std::istreambuf_iterator<char>(stream), {}};
  const auto replaced = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const std::string& bad :
       {std::string(), good.substr(0, good.size() / 2), replaced("\"version\":", "\"version\":9"),
        replaced("\"parents\":[", "\"parents\":[0,"), replaced("\"labels\":[0", "\"labels\":[99"),
        replaced("\"parts\":", "\"parts\":7"), std::string("[]"), std::string("{}")}) {
    std::ofstream(index_of("ball.off")) << bad;
    PartIndex ignored;
    EXPECT_FALSE(read_part_index(index_of("ball.off"), first.meshes[0].content, ignored)) << bad.substr(0, 80);
  }
  EXPECT_EQ(open_part_database(folder_.path()).indexed, 1);
  std::ifstream again(index_of("ball.off"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(again), {}), good);
}

TEST_F(PartDatabaseTest, TheIndexMayLieElsewhereAndBadMeshesAreLeftOut) {
  std::ofstream(folder_.path() / "bad.off") << "OFF\n3 1 0\n";
  TestFolder other;
  const PartDatabase database = open_part_database(folder_.path(), other.path() / "kept");
  EXPECT_EQ(database.meshes.size(), 2u);
  ASSERT_EQ(database.skipped.size(), 1u);
  EXPECT_EQ(database.skipped[0].file, "bad.off");
  EXPECT_THAT(database.skipped[0].reason, testing::HasSubstr("bad.off"));
  EXPECT_FALSE(fs::exists(folder_.path() / ".partwise"));
  EXPECT_TRUE(fs::exists(other.path() / "kept" / "ball.off.parts.json"));
}

TEST_F(PartDatabaseTest, RefusesFoldersWithoutMeshes) {
  TestFolder empty;
  EXPECT_THROW(open_part_database(empty.path()), InputError);
  EXPECT_THROW(open_part_database(empty.path() / "missing"), InputError);
  std::ofstream(folder_.path() / "file") << "";
  EXPECT_THROW(open_part_database(folder_.path(), folder_.path() / "file" / "kept"), InputError);
}

TEST_F(PartDatabaseTest, WhatIsDoneStaysWhenStopped) {
  int calls = 0;
  bool stop = false;
  const Progress progress{[&](std::string_view, double done) { stop = done > 0 && ++calls > 0; }, [&] { return stop; }};
  EXPECT_THROW(open_part_database(folder_.path(), {}, progress), Cancelled);
  EXPECT_EQ(open_part_database(folder_.path()).indexed, 1);
}

}  // namespace
}  // namespace partwise
