#include "partwise/parts/surface/piece_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "partwise/parts/surface/continuous_visibility.h"
#include "partwise/parts/surface/face_clustering.h"
#include "partwise/parts/surface/fitted_borders.h"
#include "partwise/parts/surface/piece_merging.h"
#include "partwise/parts/surface/test_surfaces.h"

namespace partwise {
namespace {

// Pieces of a surface by the heights of its faces.
Components slices(const Mesh& mesh, const std::vector<double>& levels) {
  std::vector<int> labels;
  for (const double z : face_means(mesh, mesh.vertices.col(2))) {
    int label = 0;
    for (const double level : levels) label += z > level;
    labels.push_back(label);
  }
  return label_pieces(face_adjacency(mesh), labels);
}

Eigen::VectorXd heights(const Mesh& mesh) { return face_means(mesh, mesh.vertices.col(2)); }

TEST(PieceGraph, TermsOfTwoHalvesOfABall) {
  const Mesh mesh = test::sphere(1, 60);
  const Components pieces = slices(mesh, {0});
  ASSERT_EQ(pieces.count, 2);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(mesh.faces.rows());
  const PieceGraph graph(mesh, heights(mesh), 0.3 * ones, pieces);
  const BorderTerms terms = graph.terms(0, 1);
  EXPECT_EQ(terms[one], 1);
  // The equator over the root of half the area, both over the root of the whole: 2 pi / sqrt(2 pi). Zigzags are longer.
  EXPECT_NEAR(terms[width], std::sqrt(2 * std::numbers::pi), 0.5);
  EXPECT_NEAR(terms[visible_step], 0.5, 0.02);  // mean heights of 1/2 and -1/2 on a scale of 2
  EXPECT_NEAR(terms[thick_step], 0, 1e-12);
  EXPECT_NEAR(terms[seen_across], 1, 1e-6);  // convex: all see all
  EXPECT_NEAR(terms[seen_together], 1, 1e-6);
  EXPECT_NEAR(terms[smaller], std::log(0.5), 0.02);
  EXPECT_NEAR(terms[together], 0, 1e-3);
}

TEST(PieceGraph, BallsOfADumbbellHardlySeeEachOther) {
  const Mesh mesh = test::dumbbell(60, 40);
  const Components pieces = slices(mesh, {0});
  const BorderTerms terms = PieceGraph(mesh, heights(mesh), heights(mesh).cwiseAbs(), pieces).terms(0, 1);
  EXPECT_LT(terms[seen_across], 0.2);
  EXPECT_LT(terms[width], 1);  // a neck
}

TEST(PieceGraph, JoinedPiecesAreAsIfTheyHadBeenOne) {
  const Mesh mesh = test::dumbbell(40, 24);
  const Components five = slices(mesh, {-1.2, -0.4, 0.5, 1.5}), three = slices(mesh, {-0.4, 1.5});
  ASSERT_EQ(five.count, 5);
  ASSERT_EQ(three.count, 3);
  const Eigen::VectorXd thickness = heights(mesh).cwiseAbs();
  PieceGraph graph(mesh, heights(mesh), thickness, five);
  const auto at = [&](const Components& pieces, double z) {  // the piece at a height
    Eigen::Index face = 0;
    (heights(mesh).array() - z).abs().minCoeff(&face);
    return pieces.label[face];
  };
  const auto join = [&](double z, double other) {
    const int a = at(five, z), b = at(five, other);
    const auto [low, high] = std::minmax(a, b);
    graph.join(low, high);
    return low;
  };
  const int bottom = join(-2, -0.8), middle = join(0, 1), top = at(five, 2);
  const PieceGraph whole(mesh, heights(mesh), thickness, three);
  const auto compare = [&](int a, int b, int whole_a, int whole_b) {
    BorderTerms joined = graph.terms(a, b), fresh = whole.terms(whole_a, whole_b);
    for (const int sampled : {seen_across, seen_together}) {  // other corners are asked
      EXPECT_NEAR(joined[sampled], fresh[sampled], 0.1);
      joined[sampled] = fresh[sampled] = 0;
    }
    EXPECT_LT((joined - fresh).cwiseAbs().maxCoeff(), 1e-9) << joined.transpose() << "\n" << fresh.transpose();
  };
  compare(bottom, middle, at(three, -2), at(three, 0));
  compare(middle, top, at(three, 0), at(three, 2));
}

TEST(PieceGraph, TermsHaveNoUnitAndComponentsCountForThemselves) {
  const Mesh mesh = test::dumbbell(40, 24);
  Mesh two = mesh;  // and a ball a thousand times as large, of one piece
  const Mesh ball = test::sphere(1000, 20);
  two.vertices.conservativeResize(mesh.vertices.rows() + ball.vertices.rows(), 3);
  two.vertices.bottomRows(ball.vertices.rows()) = ball.vertices.rowwise() + Point(5000, 0, 0);
  two.faces.conservativeResize(mesh.faces.rows() + ball.faces.rows(), 3);
  two.faces.bottomRows(ball.faces.rows()) = ball.faces.array() + static_cast<int>(mesh.vertices.rows());
  Components pieces = slices(mesh, {-0.4, 1.5});
  const Eigen::VectorXd values = Eigen::VectorXd::Ones(two.faces.rows());
  const BorderTerms alone =
      PieceGraph(mesh, values.head(mesh.faces.rows()), values.head(mesh.faces.rows()), pieces).terms(0, 1);
  pieces.label.resize(two.faces.rows(), pieces.count++);
  const BorderTerms beside = PieceGraph(two, values, values, pieces).terms(0, 1);
  for (const int term : {flatness, width, smaller, together}) EXPECT_NEAR(beside[term], alone[term], 1e-12);
  Mesh large = mesh;
  large.vertices *= 1e6;
  pieces = slices(large, {-0.4e6, 1.5e6});
  const BorderTerms scaled =
      PieceGraph(large, values.head(mesh.faces.rows()), 1e6 * values.head(mesh.faces.rows()), pieces).terms(0, 1);
  for (const int term : {flatness, width, visible_step, seen_across, seen_together, smaller, together})
    EXPECT_NEAR(scaled[term], alone[term], 1e-6) << term;
}

// Merging by a score that is kept up to date is merging by one that is computed anew for all borders.
TEST(PieceMerging, TakesTheLeastBorderEachTime) {
  const Mesh mesh = test::dumbbell(40, 24);
  const Components pieces = slices(mesh, {-2, -1.5, -1, -0.5, 0, 0.5, 1, 1.5, 2});
  const PieceGraph start(mesh, heights(mesh), heights(mesh).cwiseAbs(), pieces);
  const auto score = [](const PieceGraph& graph, int a, int b) { return graph.share(a) * graph.share(b); };
  PieceGraph quick = start, slow = start;
  std::vector<std::pair<int, int>> joins;
  merge_pieces(quick, score, 0.02, [&](int a, int b) { joins.emplace_back(a, b); });
  for (const auto& join : joins) {
    std::pair<double, std::pair<int, int>> least{1e9, {}};
    for (int a = 0; a < slow.pieces(); ++a)
      for (const auto& [b, border] : slow.neighbours(a))
        if (a < b) least = std::min(least, {score(slow, a, b), {a, b}});
    EXPECT_LT(least.first, 0.02);
    EXPECT_EQ(least.second, join);
    slow.join(join.first, join.second);
  }
  EXPECT_GT(joins.size(), 2u);
  for (int a = 0; a < slow.pieces(); ++a)
    for (const auto& [b, border] : slow.neighbours(a)) EXPECT_GE(score(slow, std::min(a, b), std::max(a, b)), 0.02);
}

TEST(PieceMerging, KeepsNecksAndDropsBordersOnBalls) {
  const Mesh mesh = test::dumbbell(60, 40);
  const Components pieces = slices(mesh, {-1.5, -0.45, 0.45, 1.5});
  const Eigen::VectorXd visible = face_means(mesh, continuous_visibility(mesh, {.kind = VisibilityKind::avg}).values);
  Eigen::VectorXd thickness = Eigen::VectorXd::Constant(mesh.faces.rows(), 1.4);
  for (Eigen::Index f = 0; f < thickness.size(); ++f)
    if (std::abs(heights(mesh)[f]) < 0.45) thickness[f] = 0.45;
  const std::vector<int> part = merge_pieces(PieceGraph(mesh, visible, thickness, pieces), fitted_borders());
  EXPECT_EQ(std::set<int>(part.begin(), part.end()), (std::set<int>{0, 2, 3}));
  EXPECT_EQ(PieceGraph(mesh, visible, thickness, pieces).pieces(), 5);
}

}  // namespace
}  // namespace partwise
