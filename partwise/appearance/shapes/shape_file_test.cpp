#include "partwise/appearance/shapes/shape_file.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/test_folder.h"

namespace partwise {
namespace {

// Two squares side by side that share no vertex by number and two by place, and one far away.
constexpr char three_squares[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "v 1 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\n"
    "v 9 0 0\nv 9 5 0\nv 9 5 5\nv 9 0 5\n"
    "usemtl oak wood\nf 1 2 3 4\nusemtl steel\nf 5 6 7 8\nusemtl oak wood\nf 9 10 11 12\n";

class ShapeFiles : public testing::Test {
 protected:
  std::vector<int> parts(const char* bytes, const PartSettings& settings, const char* name = "a.obj") {
    const ShapeFile shape{folder_.path() / name};
    write_file(shape.file, bytes);
    return worn_parts(shape, read_shape(shape), settings);
  }

  TestFolder folder_;
};

TEST_F(ShapeFiles, WhatTouchesIsOneComponent) {
  EXPECT_THAT(parts(three_squares, {.rule = PartRule::components}), testing::ElementsAre(0, 0, 0, 0, 1, 1));
}

TEST_F(ShapeFiles, PartsAreWhatTheFacesWear) {
  EXPECT_THAT(parts(three_squares, {.rule = PartRule::materials}), testing::ElementsAre(0, 0, 1, 1, 0, 0));
}

TEST_F(ShapeFiles, AtMostSoManyGroupsAreLeft) {
  EXPECT_THAT(parts(three_squares, {.rule = PartRule::materials, .groups = 1}), testing::Each(0));
  EXPECT_THAT(parts(three_squares, {.rule = PartRule::whole}), testing::Each(0));
}

TEST_F(ShapeFiles, SolidRulesLabelEveryFace) {
  // Two boxes that meet in an L: CoRiSE takes them apart.
  const ShapeFile shape{std::filesystem::path(PARTWISE_TEST_DATA) / "examples" / "notch.obj"};
  const Mesh mesh = read_shape(shape);
  const std::vector<int> labels = worn_parts(shape, mesh, {.rule = PartRule::corise, .tolerance = 0.05});
  ASSERT_EQ(static_cast<Eigen::Index>(labels.size()), mesh.faces.rows());
  EXPECT_GE(*std::ranges::max_element(labels), 1);
  EXPECT_EQ(worn_parts(shape, mesh, {.rule = PartRule::cvf}).size(), labels.size());
}

TEST_F(ShapeFiles, LabelsSayWhichFacesAreOnePart) {
  ShapeFile shape{folder_.path() / "a.obj"};
  shape.labels = folder_.path() / "a.seg";
  write_file(shape.file, three_squares);
  write_file(shape.labels, "5\n5\n2\n2\n5\n5\n");
  const Mesh mesh = read_shape(shape);
  EXPECT_THAT(worn_parts(shape, mesh, {.rule = PartRule::labels}), testing::ElementsAre(0, 0, 1, 1, 0, 0));
  write_file(shape.labels, "5\n5\n");
  try {
    worn_parts(shape, mesh, {.rule = PartRule::labels});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a.seg: has 2 labels, " + shape.file.string() + " has 6 faces"));
  }
}

TEST_F(ShapeFiles, SayWhatIsWrong) {
  const auto message = [&](const char* bytes, const PartSettings& settings, const char* name) {
    try {
      parts(bytes, settings, name);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  constexpr char flat[] = "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", plain[] = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  EXPECT_THAT(message(flat, {}, "a.obj"), testing::HasSubstr("no face of positive area"));
  EXPECT_THAT(message(plain, {.rule = PartRule::materials}, "a.obj"), testing::HasSubstr("names no materials"));
  EXPECT_THAT(message("OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n", {.rule = PartRule::materials}, "a.off"),
              testing::HasSubstr("a.off: is no OBJ file"));
  EXPECT_THAT(message("no zip", {}, "a.sh3f"), testing::HasSubstr("a.sh3f"));
}

}  // namespace
}  // namespace partwise
