// The library calls what it is given "mesh" or "scene"; here it is a file, and messages name that.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "partwise/base/error.h"

namespace partwise::cli {

// Returns what `work` returns; an InputError whose place is `place` is thrown again with the place `file`.
template <typename Work>
decltype(auto) naming(std::string_view place, const std::string& file, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const InputError& error) {
    constexpr std::string_view colon = ": ", remedy = "; ";
    const std::string_view text = error.what();
    const std::size_t begin = place.size() + colon.size(), end = text.find(remedy);
    if (!text.starts_with(std::string(place).append(colon)) || end == std::string_view::npos) throw;
    throw InputError(file, std::string(text.substr(begin, end - begin)), std::string(text.substr(end + remedy.size())));
  }
}

template <typename Work>
decltype(auto) naming_mesh(const std::string& file, Work&& work) {
  return naming("mesh", file, std::forward<Work>(work));
}

template <typename Work>
decltype(auto) naming_scene(const std::string& file, Work&& work) {
  return naming("scene", file, std::forward<Work>(work));
}

}  // namespace partwise::cli
