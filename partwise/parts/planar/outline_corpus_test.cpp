// Every file of data/outline_corpus gives what expected.json says: a valid shape of that area and number of holes,
// repaired or not, or one line of message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "partwise/base/error.h"
#include "partwise/geometry/polygon_validity.h"
#include "partwise/parts/planar/read_shape.h"

namespace partwise {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::filesystem::path corpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "outline_corpus";

nlohmann::json expected() {
  std::ifstream file(corpus / "expected.json");
  return nlohmann::json::parse(file);
}

void expect_shape(const PolygonFile& file, const nlohmann::json& expected) {
  EXPECT_NEAR(area(file.polygons), expected.at("area").get<double>(), 1e-6);
  std::size_t holes = 0;
  for (const Polygon& polygon : file.polygons) holes += polygon.holes.size();
  EXPECT_EQ(holes, expected.at("holes").get<std::size_t>());
  EXPECT_EQ(file.repaired, expected.value("repaired", ""));
  EXPECT_FALSE(find_fault(file.polygons).has_value());
}

TEST(OutlineCorpus, GivesTheShapeOrTheMessageThatIsExpected) {
  for (const auto& each : expected()) {
    const std::string name = each.at("file");
    SCOPED_TRACE(name);
    const std::filesystem::path path = corpus / name;
    try {
      const PolygonFile file = read_shape(path);
      if (each.contains("error")) {
        ADD_FAILURE() << "was read, but should say: " << each.at("error");
      } else {
        expect_shape(file, each);
      }
    } catch (const InputError& error) {
      const std::string message = error.what();
      if (!each.contains("error")) {
        ADD_FAILURE() << message;
        continue;
      }
      EXPECT_THAT(message, StartsWith(path.string()));
      EXPECT_THAT(message, HasSubstr(each.at("error").get<std::string>()));
      EXPECT_THAT(message, HasSubstr("; ")) << "no remedy";
      EXPECT_THAT(message, Not(HasSubstr("\n")));
      EXPECT_LT(message.size(), path.string().size() + 300);
    }
  }
}

TEST(OutlineCorpus, StrictReadingRefusesWhatWouldBeRepaired) {
  int refused = 0;
  for (const auto& each : expected()) {
    if (!each.contains("repaired")) continue;
    SCOPED_TRACE(each.at("file").get<std::string>());
    ++refused;
    EXPECT_THROW(read_shape(corpus / each.at("file").get<std::string>(), {.repair = false}), InputError);
  }
  EXPECT_GE(refused, 4);
}

TEST(OutlineCorpus, ListsEveryFile) {
  std::set<std::string> listed{"expected.json", "README.md"};
  for (const auto& each : expected()) {
    EXPECT_TRUE(listed.insert(each.at("file").get<std::string>()).second) << each << " is listed twice";
  }
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
    EXPECT_TRUE(listed.contains(entry.path().filename().string())) << entry.path();
  }
}

}  // namespace
}  // namespace partwise
