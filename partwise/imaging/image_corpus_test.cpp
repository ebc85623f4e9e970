// Every file of data/image_corpus gives what expected.json says: an image of that size, or one line of message.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_corpus.h"
#include "partwise/imaging/exr.h"
#include "partwise/imaging/hdr.h"
#include "partwise/imaging/image_io.h"

namespace partwise {
namespace {

const std::filesystem::path corpus = std::filesystem::path(PARTWISE_TEST_DATA) / "data" / "image_corpus";

TEST(ImageCorpus, GivesTheImageOrTheMessageThatIsExpected) {
  test::replay_corpus(corpus, [](const std::filesystem::path& path, const nlohmann::json& expected) {
    const Image image = read_image(path);
    if (expected.contains("error")) return;
    EXPECT_EQ(image.width, expected.at("width").get<int>());
    EXPECT_EQ(image.height, expected.at("height").get<int>());
    EXPECT_EQ(image.channels, expected.at("channels").get<int>());
  });
}

TEST(ImageCorpus, ListsEveryFile) {
  EXPECT_GE(test::corpus_cases(corpus).size(), 40u);
  test::expect_all_listed(corpus, {"README.md", ".gitattributes"});
}

void expect_image_or_message(const std::string& name, std::string_view bytes) {
  try {
    const Image image = name.ends_with(".exr") ? decode_exr(name, bytes) : decode_hdr(name, bytes);
    EXPECT_GT(image.values.size(), 0u);
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

// Whatever is left of a file, it is an image or a message.
TEST(ImageCorpus, SurvivesCuttingAnywhere) {
  for (const char* name :
       {"zip.exr", "dwab.exr", "b44.exr", "moved_window.exr", "runs.hdr", "plain.hdr", "pixel_runs.hdr"}) {
    SCOPED_TRACE(name);
    const std::string bytes = read_bytes(corpus / name);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::string_view cut = std::string_view(bytes).substr(0, i);
      EXPECT_THROW(std::string_view(name).ends_with(".exr") ? decode_exr(name, cut) : decode_hdr(name, cut), InputError)
          << i;
    }
  }
}

TEST(ImageCorpus, SurvivesChangingEveryByte) {
  for (const char* name : {"dwab.exr", "b44.exr", "runs.hdr", "plain.hdr"}) {
    SCOPED_TRACE(name);
    std::string bytes = read_bytes(corpus / name);
    for (char& byte : bytes) {
      for (const unsigned char change : {0x01, 0x10, 0x80}) {
        byte = static_cast<char>(byte ^ change);
        expect_image_or_message(name, bytes);
        byte = static_cast<char>(byte ^ change);
      }
    }
  }
}

}  // namespace
}  // namespace partwise
