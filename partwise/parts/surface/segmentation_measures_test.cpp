#include "partwise/parts/surface/segmentation_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "partwise/base/error.h"

namespace partwise {
namespace {

using Labels = std::vector<int>;

// Squares of side 1, columns x rows of them, each cut along the same diagonal: faces 2 k and 2 k + 1 of square k, and
// vertices, row by row.
Mesh grid(int columns, int rows) {
  Mesh mesh;
  const int corners = (columns + 1) * (rows + 1), faces = 2 * columns * rows;
  mesh.vertices.resize(corners, 3);
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= columns; ++x) mesh.vertices.row(y * (columns + 1) + x) = Point(x, y, 0);
  mesh.faces.resize(faces, 3);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const int corner = y * (columns + 1) + x, square = y * columns + x;
      mesh.faces.row(2 * square) << corner, corner + 1, corner + columns + 2;
      mesh.faces.row(2 * square + 1) << corner, corner + columns + 2, corner + columns + 1;
    }
  return mesh;
}

// Label 0 for squares left of x = border, else 1.
Labels left_and_right(int columns, int rows, int border) {
  Labels labels;
  for (int square = 0; square < columns * rows; ++square) labels.insert(labels.end(), 2, square % columns >= border);
  return labels;
}

Labels random_labels(std::size_t faces, int segments, std::mt19937_64& random) {
  Labels labels(faces);
  for (int& label : labels) label = std::uniform_int_distribution<int>(0, segments - 1)(random);
  return labels;
}

// Faces of very different areas.
Mesh uneven_grid(int columns, int rows, std::mt19937_64& random) {
  Mesh mesh = grid(columns, rows);
  std::uniform_real_distribution<double> side(-0.45, 0.45);
  for (auto vertex : mesh.vertices.rowwise()) {
    vertex += Point(side(random), side(random), side(random));
    vertex[0] *= vertex[0];
  }
  return mesh;
}

std::vector<double> areas_of(const Mesh& mesh) {
  std::vector<double> areas;
  for (const auto& f : mesh.faces.rowwise()) {
    const Point a = mesh.vertices.row(f[0]), b = mesh.vertices.row(f[1]), c = mesh.vertices.row(f[2]);
    areas.push_back((b - a).cross(c - a).norm() / 2);
  }
  return areas;
}

std::vector<double> values(const SegmentationMeasures& m) {
  return {m.rand_error,    m.cut_discrepancy,    m.hamming,          m.hamming_missing,
          m.hamming_false, m.consistency_global, m.consistency_local};
}

void expect_near(const SegmentationMeasures& a, const SegmentationMeasures& b, double tolerance) {
  for (std::size_t i = 0; i < values(a).size(); ++i)
    EXPECT_NEAR(values(a)[i], values(b)[i], tolerance) << "field " << i;
}

// The definitions as they are written, by pairs of faces and sets of faces, without a table.
SegmentationMeasures brute_force(const Mesh& mesh, const Labels& s, const Labels& r) {
  const std::vector<double> areas = areas_of(mesh);
  const std::size_t m = s.size();
  SegmentationMeasures result;
  double pairs = 0, refinement_s = 0, refinement_r = 0;
  for (std::size_t i = 0; i < m; ++i) {
    double in_s = 0, in_r = 0, in_both = 0;
    for (std::size_t j = 0; j < m; ++j) {
      if (j < i) {
        ++pairs;
        result.rand_error += (s[i] == s[j]) != (r[i] == r[j]);
      }
      in_s += s[i] == s[j] ? areas[j] : 0;
      in_r += r[i] == r[j] ? areas[j] : 0;
      in_both += s[i] == s[j] && r[i] == r[j] ? areas[j] : 0;
    }
    const double of_s = (in_s - in_both) / in_s, of_r = (in_r - in_both) / in_r;
    refinement_s += of_s / static_cast<double>(m);
    refinement_r += of_r / static_cast<double>(m);
    result.consistency_local += std::min(of_s, of_r) / static_cast<double>(m);
  }
  result.rand_error /= pairs;
  result.consistency_global = std::min(refinement_s, refinement_r);

  const double total = std::accumulate(areas.begin(), areas.end(), 0.0);
  const auto unmatched = [&](const Labels& of, const Labels& by) {
    double sum = 0;
    for (const int segment : std::set<int>(of.begin(), of.end())) {
      double best = 0, whole = 0;
      for (const int other : std::set<int>(by.begin(), by.end())) {
        double covered = 0;
        for (std::size_t i = 0; i < m; ++i) covered += of[i] == segment && by[i] == other ? areas[i] : 0;
        best = std::max(best, covered);
        whole += covered;
      }
      sum += whole - best;
    }
    return sum / total;
  };
  result.hamming_missing = unmatched(r, s);
  result.hamming_false = unmatched(s, r);
  result.hamming = (result.hamming_missing + result.hamming_false) / 2;
  return result;
}

// All shortest paths (Floyd, Warshall), all pairs of cut vertices.
double brute_force_cut_discrepancy(const Mesh& mesh, const Labels& s, const Labels& r) {
  const Eigen::Index n = mesh.vertices.rows();
  Eigen::MatrixXd length = Eigen::MatrixXd::Constant(n, n, 1e300);
  length.diagonal().setZero();
  std::map<std::pair<int, int>, std::vector<int>> faces_at;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.faces(f, k), b = mesh.faces(f, (k + 1) % 3);
      length(a, b) = length(b, a) = (mesh.vertices.row(a) - mesh.vertices.row(b)).norm();
      faces_at[std::minmax(a, b)].push_back(static_cast<int>(f));
    }
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) length(i, j) = std::min(length(i, j), length(i, k) + length(k, j));
  const auto cut = [&](const Labels& labels) {
    std::set<int> vertices;
    for (const auto& [edge, faces] : faces_at)
      for (const int face : faces)
        if (labels[face] != labels[faces[0]]) vertices.insert({edge.first, edge.second});
    return vertices;
  };
  double total = 0;
  const std::set<int> of_s = cut(s), of_r = cut(r);
  for (const auto& [from, to] : {std::pair(of_s, of_r), std::pair(of_r, of_s)})
    for (const int v : from) {
      double least = 1e300;
      for (const int w : to) least = std::min(least, length(v, w));
      total += least;
    }
  const std::vector<double> areas = areas_of(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const auto centroid_of = [&](Eigen::Index f) {
    return Point((mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) +
                  mesh.vertices.row(mesh.faces(f, 2))) /
                 3);
  };
  Point centroid = Point::Zero();
  for (std::size_t f = 0; f < areas.size(); ++f)
    centroid += areas[f] * centroid_of(static_cast<Eigen::Index>(f)) / area;
  double radius = 0;
  for (std::size_t f = 0; f < areas.size(); ++f)
    radius += areas[f] * (centroid_of(static_cast<Eigen::Index>(f)) - centroid).norm() / area;
  return total / static_cast<double>(of_s.size() + of_r.size()) / radius;
}

TEST(SegmentationMeasures, EqualTheirDefinitionsOnRandomLabels) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 40; ++round) {
    const Mesh mesh = uneven_grid(4 + round % 4, 2 + round % 5, random);
    const std::size_t faces = static_cast<std::size_t>(mesh.faces.rows());
    const Labels s = random_labels(faces, 1 + round % 7, random), r = random_labels(faces, 2 + round % 3, random);
    SegmentationMeasures expected = brute_force(mesh, s, r);
    const SegmentationMeasures found = compare_segmentations(mesh, s, r);
    expected.cut_discrepancy = round % 7 == 0 ? 0 : brute_force_cut_discrepancy(mesh, s, r);
    if (round % 7 == 0) {
      EXPECT_TRUE(std::isnan(found.cut_discrepancy));  // s has one segment
      SegmentationMeasures rest = found;
      rest.cut_discrepancy = 0;
      expect_near(rest, expected, 1e-12);
    } else {
      expect_near(found, expected, 1e-12);
    }
  }
}

TEST(SegmentationMeasures, ClosedFormsOfAMovedBorder) {
  // Ten by two squares; the border at x = 4 in one, x = 6 in the other.
  const Mesh mesh = grid(10, 2);
  const SegmentationMeasures found = compare_segmentations(mesh, left_and_right(10, 2, 4), left_and_right(10, 2, 6));
  // Of 40 faces, 8 changed sides: apart in one only are the pairs of a changed face with one that stayed.
  EXPECT_DOUBLE_EQ(found.rand_error, 8.0 * 32 / (40 * 39 / 2));
  // Each segment's best match misses 2 of 10 columns in all, in both directions.
  EXPECT_DOUBLE_EQ(found.hamming_missing, 0.2);
  EXPECT_DOUBLE_EQ(found.hamming_false, 0.2);
  EXPECT_DOUBLE_EQ(found.hamming, 0.2);
  // Columns 0-3: {0, 2/6}; 4-5: {4/6, 4/6}; 6-9: {2/6, 0} as shares outside in (first, second).
  EXPECT_NEAR(found.consistency_global, 0.2 * 4 / 6 + 0.4 * 2 / 6, 1e-14);
  EXPECT_NEAR(found.consistency_local, 0.2 * 4 / 6, 1e-14);
  // Straight cuts two apart, joined by edges along x.
  double radius = 0;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0})
    for (const auto& [dx, dy] : {std::pair(2 / 3.0, 1 / 3.0), std::pair(1 / 3.0, 2 / 3.0)})
      radius += (std::hypot(x + dx, dy) + std::hypot(x + dx, 1 - dy)) / 20;
  EXPECT_NEAR(found.cut_discrepancy, 2 / radius, 1e-12);
}

TEST(SegmentationMeasures, AreZeroForASegmentationAndItself) {
  std::mt19937_64 random(2);
  const Mesh mesh = uneven_grid(7, 5, random);
  for (const int segments : {1, 2, 6, 1000}) {
    const Labels labels = random_labels(70, segments, random);
    EXPECT_THAT(values(compare_segmentations(mesh, labels, labels)), testing::Each(0.0));
  }
}

TEST(SegmentationMeasures, SidesChangePlacesWithMissingAndFalse) {
  std::mt19937_64 random(3);
  const Mesh mesh = uneven_grid(8, 4, random);
  const Labels s = random_labels(64, 3, random), r = random_labels(64, 9, random);
  const SegmentationMeasures there = compare_segmentations(mesh, s, r);
  SegmentationMeasures back = compare_segmentations(mesh, r, s);
  EXPECT_NE(there.hamming_missing, there.hamming_false);
  std::swap(back.hamming_missing, back.hamming_false);
  expect_near(there, back, 1e-15);
}

TEST(SegmentationMeasures, ARefinementIsConsistentAndNotTheSame) {
  const Mesh mesh = grid(10, 2);
  const Labels coarse = left_and_right(10, 2, 4);
  Labels fine = coarse;
  for (std::size_t face = 0; face < fine.size(); ++face) fine[face] = 2 * fine[face] + (face >= 20);
  const SegmentationMeasures found = compare_segmentations(mesh, coarse, fine);
  EXPECT_EQ(found.consistency_global, 0);
  EXPECT_EQ(found.consistency_local, 0);
  EXPECT_DOUBLE_EQ(found.hamming_missing, 0);  // each fine segment lies in a coarse one
  EXPECT_DOUBLE_EQ(found.hamming_false, 0.5);  // each coarse one is half covered by its best
  EXPECT_GT(found.rand_error, 0);
  EXPECT_GT(found.cut_discrepancy, 0);
}

TEST(SegmentationMeasures, GoByAreaButRandGoesByFaces) {
  // A large square whose labels agree, and a strip of small squares whose labels do not, cut finer or coarser.
  const auto with_strip = [](int columns) {
    Mesh mesh = grid(columns + 1, 1);
    for (auto vertex : mesh.vertices.rowwise()) vertex[0] = vertex[0] <= 1 ? vertex[0] : 1 + (vertex[0] - 1) / columns;
    return mesh;
  };
  const auto halves = [](int columns) {
    Labels labels(2 * static_cast<std::size_t>(columns + 1), 0);
    for (std::size_t face = 0; face < labels.size(); ++face)
      labels[face] = face >= static_cast<std::size_t>(columns + 2);
    return labels;
  };
  const SegmentationMeasures coarse = compare_segmentations(with_strip(2), halves(2), Labels(6, 0));
  const SegmentationMeasures fine = compare_segmentations(with_strip(40), halves(40), Labels(82, 0));
  EXPECT_NEAR(coarse.hamming_missing, 0.25, 1e-12);
  EXPECT_NEAR(fine.hamming_missing, 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(coarse.rand_error, 4.0 * 2 / 15);
  EXPECT_DOUBLE_EQ(fine.rand_error, 42.0 * 40 / (82 * 81 / 2));
}

TEST(SegmentationMeasures, DoNotDependOnNamesOrOnOrder) {
  std::mt19937_64 random(4);
  const Mesh mesh = uneven_grid(6, 6, random);
  const Labels s = random_labels(72, 5, random), r = random_labels(72, 4, random);
  const SegmentationMeasures before = compare_segmentations(mesh, s, r);

  const int names[] = {-7, 2000000000, 0, -2000000000, 3};
  Labels renamed = s;
  for (int& label : renamed) label = names[label];
  EXPECT_EQ(values(compare_segmentations(mesh, renamed, r)), values(before));

  std::vector<int> vertex_at(static_cast<std::size_t>(mesh.vertices.rows())), face_at(72);
  std::iota(vertex_at.begin(), vertex_at.end(), 0);
  std::iota(face_at.begin(), face_at.end(), 0);
  std::shuffle(vertex_at.begin(), vertex_at.end(), random);
  std::shuffle(face_at.begin(), face_at.end(), random);
  Mesh shuffled = mesh;
  Labels shuffled_s(72), shuffled_r(72);
  for (std::size_t v = 0; v < vertex_at.size(); ++v)
    shuffled.vertices.row(vertex_at[v]) = mesh.vertices.row(static_cast<Eigen::Index>(v));
  for (std::size_t f = 0; f < face_at.size(); ++f) {
    for (int k = 0; k < 3; ++k)
      shuffled.faces(face_at[f], k) = vertex_at[mesh.faces(static_cast<Eigen::Index>(f), (k + 1) % 3)];
    shuffled_s[face_at[f]] = s[f];
    shuffled_r[face_at[f]] = r[f];
  }
  expect_near(compare_segmentations(shuffled, shuffled_s, shuffled_r), before, 1e-13);
}

TEST(SegmentationMeasures, DoNotDependOnSizeOrPlace) {
  std::mt19937_64 random(5);
  Mesh mesh = uneven_grid(6, 6, random);
  const Labels s = random_labels(72, 5, random), r = random_labels(72, 4, random);
  const SegmentationMeasures before = compare_segmentations(mesh, s, r);
  mesh.vertices *= 1000;
  mesh.vertices.rowwise() += Point(3e4, -1e4, 5e3);
  expect_near(compare_segmentations(mesh, s, r), before, 1e-9);
}

TEST(CutDiscrepancy, IsUndefinedWhereOneSideHasNoCut) {
  const Mesh mesh = grid(4, 1);
  const Labels whole(8, 5), halves = left_and_right(4, 1, 2);
  EXPECT_TRUE(std::isnan(compare_segmentations(mesh, whole, halves).cut_discrepancy));
  EXPECT_TRUE(std::isnan(compare_segmentations(mesh, halves, whole).cut_discrepancy));
  EXPECT_EQ(compare_segmentations(mesh, whole, Labels(8, 1)).cut_discrepancy, 0);
}

TEST(CutDiscrepancy, IsStraightBetweenPiecesOfTheMesh) {
  // Two sheets, one 3 above the other; one segmentation cuts the lower, one the upper, at the same place.
  Mesh mesh = grid(4, 2);
  const Mesh sheet = mesh;
  mesh.vertices.conservativeResize(30, 3);
  mesh.vertices.bottomRows(15) = sheet.vertices.rowwise() + Point(0, 0, 3);
  mesh.faces.conservativeResize(32, 3);
  mesh.faces.bottomRows(16) = sheet.faces.array() + 15;
  Labels lower = left_and_right(4, 2, 2), upper(16, 0);
  lower.insert(lower.end(), 16, 0);
  const Labels cut = left_and_right(4, 2, 2);
  upper.insert(upper.end(), cut.begin(), cut.end());
  double radius = 0;
  for (Eigen::Index f = 0; f < 16; ++f) {
    const Point a = mesh.vertices.row(mesh.faces(f, 0)), b = mesh.vertices.row(mesh.faces(f, 1)),
                c = mesh.vertices.row(mesh.faces(f, 2));
    radius += ((a + b + c) / 3 - Point(2, 1, 1.5)).norm() / 16;
  }
  EXPECT_NEAR(compare_segmentations(mesh, lower, upper).cut_discrepancy, 3 / radius, 1e-12);
}

TEST(CutDiscrepancy, KnowsEdgesOfThreeFacesAndSkipsFacesThatAreNone) {
  // Three wings about an edge from vertex 0 to 1, and a face that names a vertex twice.
  Mesh mesh;
  mesh.vertices.resize(5, 3);
  mesh.vertices << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0;
  mesh.faces.resize(4, 3);
  mesh.faces << 0, 1, 2, 0, 1, 3, 0, 1, 4, 2, 2, 3;
  // The third wing is another segment, so the middle edge is a cut of both.
  EXPECT_EQ(compare_segmentations(mesh, Labels{0, 0, 1, 7}, Labels{0, 1, 1, 8}).cut_discrepancy, 0);
  // Only the face that is none differs: no cut.
  EXPECT_TRUE(std::isnan(compare_segmentations(mesh, Labels{0, 0, 0, 7}, Labels{0, 1, 1, 8}).cut_discrepancy));
}

TEST(MeanMeasures, LeavesOutWhatIsUndefined) {
  const double nothing = std::nan("");
  const SegmentationMeasures list[] = {{0.5, 1, 0.25, 0.5, 0, 0.5, 0.25}, {0, nothing, 0.5, 0, 1, 0, 0.25}, {1, 3}};
  const SegmentationMeasures mean = mean_measures(list);
  EXPECT_THAT(values(mean), testing::ElementsAre(0.5, 2, 0.25, testing::DoubleEq(0.5 / 3), testing::DoubleEq(1.0 / 3),
                                                 testing::DoubleEq(0.5 / 3), testing::DoubleEq(0.5 / 3)));
  EXPECT_TRUE(std::isnan(mean_measures(std::span(list).subspan(1, 1)).cut_discrepancy));
  EXPECT_THROW(mean_measures({}), InputError);
}

TEST(SegmentationComparison, SaysTheSameAsOneCallEach) {
  std::mt19937_64 random(6);
  const Mesh mesh = uneven_grid(5, 5, random);
  const Labels s = random_labels(50, 5, random);
  const SegmentationComparison comparison(mesh, s);
  for (int k = 2; k < 6; ++k) {
    const Labels r = random_labels(50, k, random);
    EXPECT_EQ(values(comparison.against(r)), values(compare_segmentations(mesh, s, r)));
  }
}

template <typename Work>
std::string message_of(const Work& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SegmentationMeasures, RefuseWhatDoesNotFit) {
  const Mesh mesh = grid(2, 1);
  const Labels right(4, 0), wrong(3, 0);
  const std::string remedy = ": 3 labels for a mesh of 4 faces; give one label a face, in the order of the faces";
  EXPECT_EQ(message_of([&] { compare_segmentations(mesh, wrong, right); }), "segmentation" + remedy);
  EXPECT_EQ(message_of([&] { compare_segmentations(mesh, right, wrong); }), "reference" + remedy);
  EXPECT_EQ(message_of([&] { SegmentationComparison(mesh, right).against(wrong); }), "reference" + remedy);
  EXPECT_EQ(message_of([&] { require_label_per_face(mesh, wrong, "a.seg"); }), "a.seg" + remedy);
  Mesh flat = mesh;
  flat.vertices.col(1).setZero();
  EXPECT_EQ(message_of([&] { compare_segmentations(flat, right, right); }),
            "mesh: its area is 0; give a mesh with at least one proper triangle");
}

}  // namespace
}  // namespace partwise
