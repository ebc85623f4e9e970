// What a fuzzed reader may do, whatever the bytes: read, or throw an InputError of one line.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "partwise/base/error.h"

namespace partwise::fuzz {

// Ends the program: libFuzzer keeps the input that led here.
[[noreturn]] inline void give_up(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

template <typename Read>
void expect_message_or(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) give_up("a message of several lines");
  }
}

}  // namespace partwise::fuzz
