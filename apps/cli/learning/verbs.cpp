// The verbs of partwise-learning.
#include "verbs.h"

#include <array>

namespace partwise::cli {

namespace {
constexpr std::array list = {&train_verb, &edit_verb};
}

std::span<const Verb* const> verbs() { return list; }

}  // namespace partwise::cli
