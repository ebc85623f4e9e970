// Every file of data/outline_corpus gives what expected.json says: a valid shape of that area and number of holes,
// repaired or not, or one line of message.
#include <gtest/gtest.h>

#include "partwise/base/error.h"
#include "partwise/base/test_corpus.h"
#include "partwise/geometry/polygon_validity.h"
#include "partwise/parts/planar/read_shape.h"

namespace partwise {
namespace {

const std::filesystem::path corpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "outline_corpus";

void expect_shape(const PolygonFile& file, const nlohmann::json& expected) {
  EXPECT_NEAR(area(file.polygons), expected.at("area").get<double>(), 1e-6);
  std::size_t holes = 0;
  for (const Polygon& polygon : file.polygons) holes += polygon.holes.size();
  EXPECT_EQ(holes, expected.at("holes").get<std::size_t>());
  EXPECT_EQ(file.repaired, expected.value("repaired", ""));
  EXPECT_FALSE(find_fault(file.polygons).has_value());
}

TEST(OutlineCorpus, GivesTheShapeOrTheMessageThatIsExpected) {
  test::replay_corpus(corpus, [](const std::filesystem::path& path, const nlohmann::json& expected) {
    const PolygonFile file = read_shape(path);
    if (!expected.contains("error")) expect_shape(file, expected);
  });
}

TEST(OutlineCorpus, StrictReadingRefusesWhatWouldBeRepaired) {
  int refused = 0;
  for (const auto& each : test::corpus_cases(corpus)) {
    if (!each.contains("repaired")) continue;
    SCOPED_TRACE(each.at("file").get<std::string>());
    ++refused;
    EXPECT_THROW(read_shape(corpus / each.at("file").get<std::string>(), {.repair = false}), InputError);
  }
  EXPECT_GE(refused, 4);
}

TEST(OutlineCorpus, ListsEveryFile) { test::expect_all_listed(corpus, {"README.md"}); }

}  // namespace
}  // namespace partwise
