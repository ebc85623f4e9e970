// Options of the kinds that verbs share, with messages that say what would have been right.
#pragma once

#include <CLI/App.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace partwise::cli {

// Names a file. The empty name, which a script's unset variable leaves, is wrong usage.
CLI::Option* add_file(CLI::App& command, const std::string& option, std::string& file, const std::string& help);

// MESH, which most verbs read first.
CLI::Option* add_mesh(CLI::App& command, std::string& file);

// A whole number, `least` or more.
CLI::Option* add_count(CLI::App& command, const std::string& option, int& count, int least, const std::string& help);

// A finite number above 0.
CLI::Option* add_positive(CLI::App& command, const std::string& option, double& number, const std::string& help);

template <typename Value>
using Choices = std::vector<std::pair<std::string, Value>>;

// Throws the usage error that names all choices.
[[noreturn]] void refuse_choice(const std::string& option, const std::string& word, const std::string& all);

// One of a few words. `choices` is kept by the option.
template <typename Value>
CLI::Option* add_choice(CLI::App& command, const std::string& option, Value& value, Choices<Value> choices,
                        const std::string& help) {
  std::string all;
  for (const auto& choice : choices) all += (all.empty() ? "" : "|") + choice.first;
  const auto choose = [option, &value, all, choices = std::move(choices)](const std::string& word) {
    for (const auto& [name, meaning] : choices) {
      if (name == word) {
        value = meaning;
        return;
      }
    }
    refuse_choice(option, word, all);
  };
  return command.add_option_function<std::string>(option, choose, help)->type_name(all);
}

// The word that means `value`, one of the choices.
template <typename Value>
std::string name_of(const Choices<Value>& choices, Value value) {
  return std::find_if(choices.begin(), choices.end(), [&](const auto& choice) { return choice.second == value; })
      ->first;
}

}  // namespace partwise::cli
