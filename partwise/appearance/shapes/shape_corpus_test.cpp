// Every file of data/shape_corpus gives what expected.json says: a shape with its parts, or one line of message.
#include <gtest/gtest.h>

#include <algorithm>

#include "partwise/appearance/shapes/model_archive.h"
#include "partwise/appearance/shapes/shape_file.h"
#include "partwise/base/test_corpus.h"

namespace partwise {
namespace {

const std::filesystem::path corpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "shape_corpus";

TEST(ShapeCorpus, GivesTheShapeOrTheMessageThatIsExpected) {
  test::replay_corpus(corpus, [](const std::filesystem::path& path, const nlohmann::json& expected) {
    ShapeFile shape{path};
    if (is_archive(path)) shape.model = ModelArchive(path).models().front().id;
    const Mesh mesh = read_shape(shape);
    const PartRule rule = expected.value("materials", false) ? PartRule::materials : PartRule::components;
    const std::vector<int> parts = worn_parts(shape, mesh, {.rule = rule});
    if (expected.contains("error")) return;
    EXPECT_EQ(mesh.faces.rows(), expected.at("faces").get<int>());
    EXPECT_EQ(*std::ranges::max_element(parts) + 1, expected.value("groups", 1));
  });
}

TEST(ShapeCorpus, ListsEveryFile) { test::expect_all_listed(corpus, {"README.md", ".gitattributes"}); }

}  // namespace
}  // namespace partwise
