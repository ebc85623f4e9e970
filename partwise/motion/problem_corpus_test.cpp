// Every file of data/problem_corpus gives what expected.json says: a problem, or one line of message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "partwise/base/error.h"
#include "partwise/base/test_corpus.h"
#include "partwise/base/test_folder.h"
#include "partwise/motion/planning_problem.h"

namespace partwise {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::filesystem::path kCorpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "problem_corpus";

constexpr const char* kNames[] = {"plane", "space", "se2", "se3"};

PlanningProblem read(const std::filesystem::path& path) {
  const std::filesystem::path world = path.parent_path() / "world.env";
  if (path.extension() == ".robot") return read_planning_problem(world, {.robot = path, .query = {}});
  if (path.extension() == ".query") return read_planning_problem(world, {.robot = {}, .query = path});
  return read_planning_problem(path);
}

void expect_sound(const PlanningProblem& problem) {
  EXPECT_FALSE(problem.obstacles.empty() && problem.footprints.empty());
  for (const auto* meshes : {&problem.robot, &problem.obstacles}) {
    for (const Mesh& mesh : *meshes) {
      EXPECT_GT(mesh.faces.rows(), 0);
      EXPECT_TRUE(mesh.vertices.allFinite());
    }
  }
  for (const MotionQuery& query : problem.queries) {
    EXPECT_TRUE(within_bounds(problem, query.start));
    EXPECT_TRUE(within_bounds(problem, query.goal));
  }
}

TEST(ProblemCorpus, GivesTheProblemOrTheMessageThatIsExpected) {
  test::replay_corpus(kCorpus, [](const std::filesystem::path& path, const nlohmann::json& expected) {
    const PlanningProblem problem = read(path);
    if (expected.contains("error")) return;
    EXPECT_EQ(kNames[static_cast<int>(problem.kind)], expected.at("space").get<std::string>());
    EXPECT_EQ(problem.robot.size(), expected.at("bodies").get<std::size_t>());
    EXPECT_EQ(problem.obstacles.size() + problem.footprints.size(), expected.at("obstacles").get<std::size_t>());
    EXPECT_EQ(problem.queries.size(), expected.at("queries").get<std::size_t>());
    expect_sound(problem);
  });
}

TEST(ProblemCorpus, ListsEveryFile) {
  EXPECT_GE(test::corpus_cases(kCorpus).size(), 100u);
  test::expect_all_listed(kCorpus, {"README.md", ".gitattributes", "cube.g", "cube.obj", "world.robot", "world.query"});
}

// Whatever is left of a file, or becomes of it, it is a problem or a message; the sanitizers watch over the rest.
TEST(ProblemCorpus, SurvivesCuttingAndChangingEveryByte) {
  const TestFolder folder;
  for (const char* name : {"cube.g", "cube.obj", "world.env", "world.robot", "world.query"})
    std::filesystem::copy_file(kCorpus / name, folder.path() / name);
  for (const char* name : {"se2.cfg", "active.env", "world.robot", "world.query", "se2.json"}) {
    SCOPED_TRACE(name);
    std::ifstream file(kCorpus / name, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    ASSERT_FALSE(bytes.empty());
    const auto expect_problem_or_message = [&](std::string_view changed) {
      const std::filesystem::path path = folder.path() / ("changed" + std::filesystem::path(name).extension().string());
      std::ofstream(path, std::ios::binary) << changed;
      try {
        expect_sound(read(path));
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      }
    };
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      SCOPED_TRACE(i);
      expect_problem_or_message(std::string_view(bytes).substr(0, i));
      for (const unsigned char change : {0x01, 0x80}) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(bytes[i] ^ change);
        expect_problem_or_message(changed);
      }
    }
  }
}

}  // namespace
}  // namespace partwise
