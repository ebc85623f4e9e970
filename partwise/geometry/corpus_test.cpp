// Every file of data/corpus gives what expected.json says: a mesh of that size, or one line of message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "partwise/base/error.h"
#include "partwise/base/test_corpus.h"
#include "partwise/geometry/mesh_formats.h"
#include "partwise/geometry/mesh_io.h"

namespace partwise {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::filesystem::path kCorpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "corpus";

TEST(Corpus, GivesTheMeshOrTheMessageThatIsExpected) {
  test::replay_corpus(kCorpus, [](const std::filesystem::path& path, const nlohmann::json& expected) {
    const Mesh mesh = read_mesh(path);
    if (expected.contains("error")) return;
    EXPECT_EQ(mesh.vertices.rows(), expected.at("vertices").get<int>());
    EXPECT_EQ(mesh.faces.rows(), expected.at("faces").get<int>());
    EXPECT_TRUE(mesh.vertices.allFinite());
    ASSERT_GT(mesh.faces.size(), 0);
    EXPECT_GE(mesh.faces.minCoeff(), 0);
    EXPECT_LT(mesh.faces.maxCoeff(), mesh.vertices.rows());
  });
}

TEST(Corpus, ListsEveryFile) {
  const nlohmann::json cases = test::corpus_cases(kCorpus);
  EXPECT_GE(cases.size(), 45u);
  for (const auto& each : cases) EXPECT_TRUE(each.at("decompose").is_string());
  test::expect_all_listed(kCorpus, {"README.md", ".gitattributes", "external_buffer.bin"});
}

Mesh read_as(const std::string& name, std::string_view bytes) {
  if (name.ends_with(".off")) return read_off(name, bytes);
  if (name.ends_with(".obj")) return read_obj(name, bytes);
  if (name.ends_with(".ply")) return read_ply(name, bytes);
  if (name.ends_with(".stl")) return read_stl(name, bytes);
  if (name.ends_with(".g")) return read_byu(name, bytes);
  if (name.ends_with(".glb")) return read_glb(name, bytes, kCorpus);
  return read_gltf(name, bytes, kCorpus);
}

void expect_mesh_or_message(const std::string& name, std::string_view bytes) {
  try {
    const Mesh mesh = read_as(name, bytes);
    EXPECT_GT(mesh.faces.rows(), 0);
    EXPECT_GE(mesh.faces.minCoeff(), 0);
    EXPECT_LT(mesh.faces.maxCoeff(), mesh.vertices.rows());
    EXPECT_TRUE(mesh.vertices.allFinite());
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

// Whatever is left of a file, or becomes of it, it is a mesh or a message; the sanitizers watch over the rest.
TEST(Corpus, SurvivesCuttingAndChangingEveryByte) {
  for (const char* name : {"comments.off", "colours.off", "l_prism_of_polygons.off", "all_corner_forms.obj",
                           "continued_lines.obj", "extra_elements.ply", "big_endian.ply", "little_endian.ply",
                           "ascii.stl", "binary.stl", "two_parts.g", "tetrahedron.glb", "nodes.glb", "embedded.gltf"}) {
    SCOPED_TRACE(name);
    std::ifstream file(kCorpus / name, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    ASSERT_FALSE(bytes.empty());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      SCOPED_TRACE(i);
      expect_mesh_or_message(name, std::string_view(bytes).substr(0, i));
      for (const unsigned char change : {0x01, 0x02, 0x10, 0x80}) {
        std::string changed = bytes;
        changed[i] = static_cast<char>(bytes[i] ^ change);
        expect_mesh_or_message(name, changed);
      }
    }
  }
}

}  // namespace
}  // namespace partwise
