// Settings that are one of a few words, with the words of the program's options.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "partwise/base/error.h"

namespace partwise::python {

template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// What `word` means. Errors: InputError that names all words.
template <typename Value>
Value chosen(const std::string& setting, const std::string& word, const Choices<Value>& choices) {
  std::string all;
  for (const auto& [name, value] : choices) {
    if (name == word) return value;
    all += (all.empty() ? "" : ", ") + name;
  }
  throw InputError(setting, fmt::format("{} is none of {}", word, all), "choose one of these");
}

// The word for `value`, which is one of the choices.
template <typename Value>
std::string word_for(Value value, const Choices<Value>& choices) {
  for (const auto& [name, each] : choices) {
    if (each == value) return name;
  }
  return {};
}

}  // namespace partwise::python
