#include "partwise/parts/applications/net.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include "partwise/base/error.h"
#include "partwise/geometry/convex_hull.h"
#include "partwise/parts/applications/net_sheets.h"
#include "partwise/parts/solid/test_solids.h"

namespace partwise {
namespace {

Mesh random_hull(int points, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Point stretch(1 + 4 * (seed % 3), 1, 0.2 + 0.4 * (seed % 4));
  Vertices cloud(points, 3);
  for (auto row : cloud.rowwise())
    row = Point(normal(random), normal(random), normal(random)).normalized().cwiseProduct(stretch);
  return convex_hull(cloud, 1e-9).mesh;
}

// The area that two triangles share, by clipping: another way to the same question.
double shared_area(const std::array<Eigen::Vector2d, 3>& a, const std::array<Eigen::Vector2d, 3>& b) {
  std::vector<Eigen::Vector2d> polygon(a.begin(), a.end());
  const auto cross = [](const Eigen::Vector2d& u, const Eigen::Vector2d& v) { return u.x() * v.y() - u.y() * v.x(); };
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector2d from = b[k], side = b[(k + 1) % 3] - from;
    std::vector<Eigen::Vector2d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double at_p = cross(side, p - from), at_q = cross(side, q - from);
      if (at_p >= 0) kept.push_back(p);
      if ((at_p < 0) != (at_q < 0)) kept.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    polygon = kept;
  }
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]) / 2;
  return area;
}

void expect_unfolds(const Mesh& mesh, const Unfolding& unfolding) {
  EXPECT_EQ(unfolding.overlaps, 0);
  std::multiset<int> faces;
  for (const Net& net : unfolding.nets) {
    EXPECT_EQ(count_overlaps(net), 0);
    for (std::size_t i = 0; i < net.faces.size(); ++i) {
      faces.insert(net.faces[i].face);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_LT(shared_area(net.faces[i].corners, net.faces[j].corners), 1e-12) << i << " and " << j;
    }
  }
  ASSERT_EQ(faces.size(), static_cast<std::size_t>(mesh.faces.rows()));
  EXPECT_EQ(std::set<int>(faces.begin(), faces.end()).size(), faces.size());
  EXPECT_LT(refolding_error(unfolding, mesh), 1e-9);
}

TEST(Unfold, ConvexBodiesInOnePieceWithoutOverlap) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Mesh hull = random_hull(8 + static_cast<int>(seed) * 2, seed);
    const Unfolding unfolding = unfold(hull);
    expect_unfolds(hull, unfolding);
    EXPECT_EQ(unfolding.nets.size(), 1u) << seed;
    // Every edge is folded or glued.
    EXPECT_EQ(static_cast<Eigen::Index>(unfolding.nets[0].faces.size() - 1) + unfolding.glued,
              3 * hull.faces.rows() / 2);
  }
}

TEST(Unfold, OtherSurfacesInAsManyPiecesAsItTakes) {
  for (const Mesh& mesh : {test::dumbbell(8), test::torus(1, 0.3, 12, 8), test::open_cup(1, 1, 10), test::sheet(4, 2)})
    expect_unfolds(mesh, unfold(mesh));
}

TEST(Unfold, TabsOverlapNothingAndAreOnOneSide) {
  const Mesh hull = random_hull(24, 7);
  const Unfolding unfolding = unfold(hull);
  std::map<int, int> sides, tabs;
  for (const Net& net : unfolding.nets)
    for (const NetEdge& cut : net.cuts) {
      ++sides[cut.number];
      tabs[cut.number] += !cut.tab.empty();
      if (cut.tab.empty()) continue;
      for (int half = 0; half < 2; ++half) {  // a trapezoid is two triangles
        const std::array<Eigen::Vector2d, 3> tab{cut.tab[0], cut.tab[1 + static_cast<std::size_t>(half)],
                                                 cut.tab[2 + static_cast<std::size_t>(half)]};
        for (const NetFace& face : net.faces) EXPECT_LT(shared_area(tab, face.corners), 1e-12);
      }
    }
  EXPECT_EQ(sides.size(), static_cast<std::size_t>(unfolding.glued));
  int without = 0;
  for (const auto& [number, count] : sides) {
    EXPECT_EQ(count, 2);
    EXPECT_LE(tabs[number], 1);
    without += tabs[number] == 0;
  }
  EXPECT_EQ(without, unfolding.without_tab);
}

TEST(Unfold, OverlapsAreSeen) {
  Net net;
  net.faces.push_back({.face = 0, .corners = {Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1)}});
  net.faces.push_back({.face = 1, .corners = {Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 1), Eigen::Vector2d(0, 1)}});
  EXPECT_EQ(count_overlaps(net), 0);  // they touch along a side
  net.faces[1].corners[0] = Eigen::Vector2d(std::nextafter(1.0, 0.0), 0);
  EXPECT_EQ(count_overlaps(net), 1);
}

TEST(Unfold, AWrongAngleDoesNotRefold) {
  const Mesh hull = random_hull(12, 3);
  Unfolding unfolding = unfold(hull);
  unfolding.nets[0].faces.back().angle += 1e-3;
  EXPECT_GT(refolding_error(unfolding, hull), 1e-5);
}

TEST(Unfold, RefusesWhatHasNoNet) {
  Mesh fan = test::mesh_of({{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}});
  EXPECT_THROW(unfold(fan), InputError);
  Mesh flat = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}});
  EXPECT_THROW(unfold(flat), InputError);
}

TEST(Unfold, StopsWhenAsked) {
  EXPECT_THROW(unfold(random_hull(12, 3), {}, {{}, [] { return true; }}), Cancelled);
}

TEST(NetSheets, AllNetsLieOnTheirPagesApart) {
  std::vector<Unfolding> unfoldings;
  for (std::uint64_t seed = 0; seed < 12; ++seed) unfoldings.push_back(unfold(random_hull(20, seed)));
  const Sheets sheets = lay_out(unfoldings);
  std::vector<std::pair<int, Eigen::AlignedBox2d>> boxes;
  for (const PlacedNet& placed : sheets.nets) {
    Eigen::AlignedBox2d box;
    for (const NetFace& face : placed.net.faces)
      for (const auto& p : face.corners) box.extend(p);
    for (const NetEdge& cut : placed.net.cuts)
      for (const auto& p : cut.tab) box.extend(p);
    EXPECT_GE(box.min().minCoeff(), 10 - 1e-6);
    EXPECT_LE(box.max().x(), 200 + 1e-6);
    EXPECT_LE(box.max().y(), 287 + 1e-6);
    EXPECT_LT(placed.page, sheets.pages);
    for (const auto& [page, other] : boxes)
      if (page == placed.page) {
        EXPECT_FALSE(box.intersects(other));
      }
    boxes.emplace_back(placed.page, box);
  }
  EXPECT_THROW(lay_out(unfoldings, {.scale = 2 * sheets.scale}), InputError);
  EXPECT_THROW(lay_out({}), InputError);

  tinyxml2::XMLDocument svg;
  EXPECT_EQ(svg.Parse(as_svg(sheets).c_str()), tinyxml2::XML_SUCCESS);
  // The table of a PDF says where its objects start.
  const std::string pdf = as_pdf(sheets);
  const std::size_t table = std::stoul(pdf.substr(pdf.rfind("startxref") + 10));
  EXPECT_EQ(pdf.substr(table, 4), "xref");
  for (int object = 1; object <= 3 + 2 * sheets.pages; ++object) {
    const std::size_t row = pdf.find('\n', table + 5) + 1 + 20 * static_cast<std::size_t>(object);
    const std::string head = std::to_string(object) + " 0 obj";
    EXPECT_EQ(pdf.substr(std::stoul(pdf.substr(row, 10)), head.size()), head);
  }
}

}  // namespace
}  // namespace partwise
