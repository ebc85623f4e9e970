// Replaying a folder of bad and odd files: expected.json there lists every file with "error", words of the one line of
// message that it should give, or with what a reader should find in it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "partwise/base/error.h"

namespace partwise::test {

inline nlohmann::json corpus_cases(const std::filesystem::path& corpus) {
  std::ifstream file(corpus / "expected.json");
  return nlohmann::json::parse(file);
}

// read(path, case) reads the file and expects what the case says of it.
template <typename Read>
void replay_corpus(const std::filesystem::path& corpus, const Read& read) {
  using ::testing::HasSubstr;
  for (const auto& each : corpus_cases(corpus)) {
    const std::filesystem::path path = corpus / each.at("file").get<std::string>();
    SCOPED_TRACE(path.filename().string());
    try {
      read(path, each);
      if (each.contains("error")) ADD_FAILURE() << "was read, but should say: " << each.at("error");
    } catch (const InputError& error) {
      const std::string message = error.what();
      if (!each.contains("error")) {
        ADD_FAILURE() << message;
        continue;
      }
      EXPECT_THAT(message, ::testing::StartsWith(path.string()));
      EXPECT_THAT(message, HasSubstr(each.at("error").get<std::string>()));
      EXPECT_THAT(message, HasSubstr("; ")) << "no remedy";
      EXPECT_THAT(message, ::testing::Not(HasSubstr("\n")));
      EXPECT_LT(message.size(), path.string().size() + 300);
    }
  }
}

// Every file of the folder is a case, once, or one of the others.
inline void expect_all_listed(const std::filesystem::path& corpus, std::set<std::string> others) {
  others.insert("expected.json");
  for (const auto& each : corpus_cases(corpus))
    EXPECT_TRUE(others.insert(each.at("file").get<std::string>()).second) << each << " is listed twice";
  for (const auto& entry : std::filesystem::directory_iterator(corpus))
    EXPECT_TRUE(others.contains(entry.path().filename().string())) << entry.path();
}

}  // namespace partwise::test
