// The library calls what it is given "mesh"; here it is a file, and messages name that.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "partwise/base/error.h"

namespace partwise::cli {

// Returns what `work` returns; an InputError whose place is "mesh" is thrown again with the place `file`.
template <typename Work>
decltype(auto) naming_mesh(const std::string& file, Work&& work) {
  try {
    return std::forward<Work>(work)();
  } catch (const InputError& error) {
    constexpr std::string_view place = "mesh: ", remedy = "; ";
    const std::string_view text = error.what();
    const std::size_t end = text.find(remedy);
    if (!text.starts_with(place) || end == std::string_view::npos) throw;
    throw InputError(file, std::string(text.substr(place.size(), end - place.size())),
                     std::string(text.substr(end + remedy.size())));
  }
}

}  // namespace partwise::cli
