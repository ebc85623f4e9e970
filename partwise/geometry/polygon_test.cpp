#include "partwise/geometry/polygon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"
#include "partwise/geometry/contours.h"
#include "partwise/geometry/polygon_io.h"
#include "partwise/geometry/polygon_validity.h"

namespace partwise {
namespace {

using testing::HasSubstr;

Ring ring(std::initializer_list<std::pair<double, double>> corners) {
  Ring result(static_cast<Eigen::Index>(corners.size()), 2);
  Eigen::Index i = 0;
  for (const auto& [x, y] : corners) result.row(i++) << x, y;
  return result;
}

Ring square(double x, double y, double side) {
  return ring({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}});
}

class Files : public testing::Test {
 protected:
  PolygonFile read(const std::string& name, const std::string& text, const PolygonReadSettings& settings = {}) {
    write_file(folder_.path() / name, text);
    return read_polygons(folder_.path() / name, settings);
  }
  std::string refusal(const std::string& name, const std::string& text, const PolygonReadSettings& settings = {}) {
    try {
      read(name, text, settings);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  TestFolder folder_;
};

TEST(Polygon, AreasAndDirections) {
  Polygons shape{{square(0, 0, 4), {square(1, 1, 1)}}};
  shape[0].outer = shape[0].outer.colwise().reverse().eval();
  normalise(shape);
  EXPECT_DOUBLE_EQ(signed_area(shape[0].outer), 16);
  EXPECT_DOUBLE_EQ(signed_area(shape[0].holes[0]), -1);
  EXPECT_DOUBLE_EQ(area(shape), 15);
}

TEST(Polygon, EnclosingCircleHoldsAllAndIsTight) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 50; ++round) {
    Ring points(3 + round, 2);
    for (auto& x : points.reshaped()) x = normal(random);
    const Polygons shape{{points, {}}};
    const Circle circle = enclosing_circle(shape);
    int on = 0;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double distance = (points.row(i).transpose() - circle.centre).norm();
      EXPECT_LE(distance, circle.radius * (1 + 1e-9));
      on += distance > circle.radius * (1 - 1e-9) ? 1 : 0;
    }
    EXPECT_GE(on, 2);
    // No smaller one: moving the centre any way makes the farthest point farther.
    for (int k = 0; k < 32; ++k) {
      const double angle = k * std::numbers::pi / 16;
      const Eigen::RowVector2d moved =
          circle.centre.transpose() + 1e-3 * Eigen::RowVector2d(std::cos(angle), std::sin(angle));
      EXPECT_GT((points.rowwise() - moved).rowwise().norm().maxCoeff(), circle.radius * (1 - 1e-12));
    }
  }
}

TEST(Polygon, RingsNestByBothRules) {
  const std::vector<Ring> nested{square(2, 2, 4), square(0, 0, 10), square(3, 3, 1)};
  const Polygons odd = assemble_polygons(nested, FillRule::even_odd);
  ASSERT_EQ(odd.size(), 2u);
  EXPECT_EQ(odd[0].holes.size(), 1u);
  EXPECT_DOUBLE_EQ(area(odd), 100 - 16 + 1);
  EXPECT_DOUBLE_EQ(area(assemble_polygons(nested, FillRule::non_zero)), 100);
  std::vector<Ring> opposite = nested;
  opposite[0] = nested[0].colwise().reverse().eval();
  EXPECT_DOUBLE_EQ(area(assemble_polygons(opposite, FillRule::non_zero)), 100 - 16 + 1);
}

TEST(PolygonValidity, FaultsHavePlacesAndAreRepaired) {
  const Polygons bow_tie{{ring({{0, 0}, {4, 4}, {4, 0}, {0, 4}}), {}}};
  const auto fault = find_fault(bow_tie);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->what, "self-intersection");
  EXPECT_NEAR((fault->where - Eigen::Vector2d(2, 2)).norm(), 0, 1e-12);
  const Polygons repaired = repair_polygons(bow_tie, "bow");
  EXPECT_FALSE(find_fault(repaired));
  EXPECT_DOUBLE_EQ(area(repaired), 8);
  const Polygons overlap{{square(0, 0, 4), {}}, {square(2, 2, 4), {}}};
  EXPECT_TRUE(find_fault(overlap));
  EXPECT_DOUBLE_EQ(area(repair_polygons(overlap, "two")), 28);
  EXPECT_FALSE(find_fault(Polygons{{square(0, 0, 4), {square(1, 1, 1)}}}));
}

TEST_F(Files, PolyWithHoleAndComments) {
  const std::string text = "# a comment\n2\n4 out # outer\n0 0\n4 0\n4 4\n0 4\n1 2 3 4\n3 in\n1 1\n2 1\n1 2\n3 2 1\n";
  const Polygons shape = read("a.poly", text).polygons;
  ASSERT_EQ(shape.size(), 1u);
  EXPECT_DOUBLE_EQ(area(shape), 16 - 0.5);
  EXPECT_THAT(refusal("b.poly", "1\n3 out\n0 0\n1 0\n0 1\n1 2 4\n"), HasSubstr("b.poly:6"));
  EXPECT_THAT(refusal("c.poly", "1\n3 on\n0 0\n1 0\n0 1\n1 2 3\n"), HasSubstr("c.poly:2"));
  EXPECT_THAT(refusal("d.poly", "99999999\n3 out\n"), HasSubstr("too short"));
  EXPECT_THAT(refusal("e.poly", "1\n3 in\n0 0\n1 0\n0 1\n1 2 3\n"), HasSubstr("before any outer"));
  EXPECT_THAT(refusal("f.poly", "1\n2 out\n0 0\n1 0\n1 2\n"), HasSubstr("encloses nothing"));
}

TEST_F(Files, PolyNumbersThatLostTheirBlank) {
  const std::string text = "1\n4 out\n0 0\n4.5.25\n4 4\n0 4\n1 2 3 4\n";
  EXPECT_THAT(refusal("a.poly", text), HasSubstr("a.poly:4: '4.5.25' is not a number"));
  const PolygonReadSettings lenient{.lenient = true};
  const Ring outer = read("a.poly", text, lenient).polygons[0].outer;
  EXPECT_EQ(outer.row(1), Eigen::RowVector2d(4.5, 0.25));
  EXPECT_THAT(refusal("b.poly", "1\n3 out\n0 0\n1 x\n", lenient), HasSubstr("b.poly:4"));
}

TEST_F(Files, WellKnownText) {
  EXPECT_DOUBLE_EQ(area(read("a.wkt", "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 2, 2 2, 2 1, 1 1))").polygons), 15);
  const std::string several =
      "SRID=4326;GEOMETRYCOLLECTION (POINT (1 1), MULTIPOLYGON (((0 0, 1 0, 0 1, 0 0)), ((2 0, 3 0, 2 1, 2 0))))";
  EXPECT_EQ(read("b.wkt", several).polygons.size(), 2u);
  EXPECT_THAT(refusal("c.wkt", "POLYGON ((0 0, 4 0"), HasSubstr("not well-known text"));
  EXPECT_THAT(refusal("d.wkt", "POINT (1 1)"), HasSubstr("encloses nothing"));
  EXPECT_THAT(refusal("e.wkt", ""), HasSubstr("e.wkt"));
}

TEST_F(Files, GeoJsonThereAndBack) {
  const Polygons shape{{square(0.1, 0.2, 1.0 / 3), {}}, {square(2, 2, 4), {square(3, 3, 1)}}};
  write_geojson(folder_.path() / "a.geojson", shape);
  const Polygons again = read_polygons(folder_.path() / "a.geojson").polygons;
  ASSERT_EQ(again.size(), 2u);
  EXPECT_EQ(again[0].outer, shape[0].outer);
  EXPECT_DOUBLE_EQ(area(again), area(shape));
  EXPECT_THAT(refusal("b.json", "{\"type\":\"Polygon\"}"), HasSubstr("coordinates"));
  EXPECT_THAT(refusal("c.json", "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1]]]}"), HasSubstr("corner 1"));
  EXPECT_THAT(refusal("d.json", "[1, 2"), HasSubstr("not JSON"));
  EXPECT_THAT(refusal("e.json", std::string(5000, '[')), HasSubstr("nests"));
  EXPECT_THAT(refusal("f.json", "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1e200,0],[0,1]]]}"),
              HasSubstr("too large"));
}

TEST_F(Files, SvgPathsOfAllCommands) {
  const auto svg = [&](const std::string& inner) {
    return area(read("a.svg", "<svg xmlns='x'>" + inner + "</svg>").polygons);
  };
  EXPECT_DOUBLE_EQ(svg("<path d='M0 0H4V4h-4z'/>"), 16);
  EXPECT_DOUBLE_EQ(svg("<path d='m1,1l4-0 0,4-4,0zm1 1h1v1h-1z' fill-rule='evenodd'/>"), 15);
  EXPECT_DOUBLE_EQ(svg("<path d='m1,1l4-0 0,4-4,0z m1 1h1v1h-1z'/>"), 16);  // same direction: filled
  EXPECT_DOUBLE_EQ(
      svg("<polygon points='0,0 2,0 2,2 0,2'/><g transform='translate(5) scale(2)'><rect width='1' height='3'/></g>"),
      16);
  EXPECT_NEAR(svg("<path d='M0 0A1 1 0 0 1 2 0A1 1 0 001 0'/>"),
              std::numbers::pi / 2 - (std::numbers::pi / 6 - std::sqrt(3) / 4), 5e-3);
  EXPECT_NEAR(svg("<path d='M-2 0a2 1 0 1 0 4 0a2 1 0 1 0-4 0z' transform='rotate(30)'/>"), 2 * std::numbers::pi, 2e-2);
  EXPECT_NEAR(svg("<path d='M0 0Q1 2 2 0T4 0L4-5 0-5z'/>"), 20, 0.02);          // the bulges cancel
  EXPECT_NEAR(svg("<path d='M0 0C0 1 1 1 1 0S2-1 2 0L2-5 0-5z'/>"), 10, 0.02);  // these too
  EXPECT_NEAR(svg("<path d='M0 0Q1 2 2 0z'/>"), 4.0 / 3, 2e-3);
  EXPECT_THAT(refusal("b.svg", "<svg><path d='M0 0 L1'/></svg>"), HasSubstr("b.svg:1"));
  EXPECT_THAT(refusal("c.svg", "<svg><path d='L0 0 1 1'/></svg>"), HasSubstr("begin with M"));
  EXPECT_THAT(refusal("d.svg", "<svg><path"), HasSubstr("XML"));
  EXPECT_THAT(refusal("e.svg", "<svg transform='turn(3)'/>"), HasSubstr("transform"));
}

TEST_F(Files, FlatteningKeepsItsTolerance) {
  const std::string circle = "<svg><path d='M-1 0a1 1 0 0 1 2 0a1 1 0 0 1-2 0'/></svg>";
  for (double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const Ring outer = read("a.svg", circle, {.flattening = tolerance}).polygons[0].outer;
    for (Eigen::Index i = 0; i < outer.rows(); ++i) {
      const double sag = 1 - ((outer.row(i) + outer.row((i + 1) % outer.rows())) / 2).norm();
      EXPECT_LE(sag, tolerance + 1e-5);
    }
  }
}

TEST_F(Files, FaultsAreRepairedOrRefused) {
  const std::string bow = "POLYGON ((0 0, 4 4, 4 0, 0 4, 0 0))";
  EXPECT_THAT(read("a.wkt", bow).repaired, HasSubstr("self-intersection near (2, 2)"));
  EXPECT_THAT(refusal("a.wkt", bow, {.repair = false}), HasSubstr("self-intersection near (2, 2)"));
}

// Bytes changed, cut and doubled at random: refused with one line or read, never anything else.
TEST_F(Files, BrokenFilesAreRefusedInOneLine) {
  const std::vector<std::pair<std::string, std::string>> whole{
      {"f.poly", "2\n4 out\n0 0\n4 0\n4 4\n0 4\n1 2 3 4\n3 in\n1 1\n2 1\n1 2\n3 2 1\n"},
      {"f.wkt", "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 2, 2 2, 1 1)), ((20 0, 30 0, 20 1, 20 0)))"},
      {"f.json", R"({"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,0]]]}})"},
      {"f.svg",
       "<svg><g transform='rotate(30 1 2) scale(2)'><path d='M0 0c1 2 3 4 5 6s1 2 3-4q1 1 2-2t1-1a1 2 3 0 1 "
       "4-5z'/></g></svg>"}};
  std::mt19937_64 random(7);
  for (const auto& [name, text] : whole) {
    for (int round = 0; round < 500; ++round) {
      std::string broken = text;
      for (int edits = 1 + static_cast<int>(random() % 4); edits-- > 0 && !broken.empty();) {
        const std::size_t at = random() % broken.size();
        switch (random() % 4) {
          case 0:
            broken[at] = static_cast<char>(random() % 256);
            break;
          case 1:
            broken.erase(at, 1 + random() % 5);
            break;
          case 2:
            broken.insert(at, broken.substr(random() % broken.size(), random() % 9));
            break;
          default:
            broken[at] = "0123456789.-+eE()[]{}<>,: "[random() % 26];
        }
      }
      const std::string outcome = refusal(name, broken, {.lenient = round % 2 == 0});
      EXPECT_EQ(outcome.find('\n'), std::string::npos) << broken;
    }
  }
}

TEST(Contours, DiscAtSubPixelAccuracy) {
  // Coverage of a disc, so well approximated that the contour can be judged.
  const int size = 64;
  const Eigen::Vector2d centre(31.3, 30.8);
  const double radius = 20.4;
  std::vector<float> values(size * size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double distance = (Eigen::Vector2d(x + 0.5, y + 0.5) - centre).norm();
      values[y * size + x] = static_cast<float>(std::clamp(radius - distance + 0.5, 0.0, 1.0));
    }
  }
  const Polygons disc = trace_contours(values, size, size);
  ASSERT_EQ(disc.size(), 1u);
  for (Eigen::Index i = 0; i < disc[0].outer.rows(); ++i) {
    EXPECT_NEAR((disc[0].outer.row(i).transpose() - centre).norm(), radius, 0.1);
  }
}

TEST(Contours, RandomMasksGiveValidPolygonsThatEncloseTheirPixels) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 60; ++round) {
    const int width = 3 + round % 17, height = 2 + round % 13;
    std::vector<float> values(width * height);
    for (float& v : values)
      v = round % 2 ? static_cast<float>(random() % 2) : static_cast<float>(random() % 1000) / 999.0f;
    if (round % 3 == 0) values[0] = 0.5f;
    const Polygons shape = trace_contours(values, width, height);
    EXPECT_FALSE(find_fault(shape));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        int turns = 0;
        for (const Polygon& polygon : shape) {
          std::vector<Ring> rings = polygon.holes;
          rings.push_back(polygon.outer);
          for (const Ring& ring : rings) {
            for (Eigen::Index i = 0; i < ring.rows(); ++i) {
              const Eigen::Vector2d a = ring.row(i), b = ring.row((i + 1) % ring.rows());
              if ((a.y() > y + 0.5) == (b.y() > y + 0.5)) continue;
              if (a.x() + (y + 0.5 - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > x + 0.5)
                turns += b.y() > a.y() ? 1 : -1;
            }
          }
        }
        EXPECT_EQ(turns, values[y * width + x] > 0.5f ? 1 : 0);
      }
    }
  }
}

TEST(Contours, IslandsInHoles) {
  std::vector<float> values(7 * 7, 1.0f);
  for (int y = 1; y < 6; ++y) {
    for (int x = 1; x < 6; ++x) values[y * 7 + x] = x == 3 && y == 3 ? 1.0f : 0.0f;
  }
  const Polygons shape = trace_contours(values, 7, 7);
  ASSERT_EQ(shape.size(), 2u);
  EXPECT_EQ(shape[0].holes.size(), 1u);
  EXPECT_DOUBLE_EQ(area(shape), (49 - 0.5) - (25 - 0.5) + 0.5);
}

}  // namespace
}  // namespace partwise
