// The verbs of partwise-learning.
#include "verbs.h"

#include <array>

#include "learning_verbs.h"

namespace partwise::cli {

namespace {
constexpr std::array list = {&train_verb, &edit_verb, &normals_verb};
}

std::span<const Verb* const> verbs() { return list; }
std::span<const LearningVerb> verbs_elsewhere() { return {}; }

}  // namespace partwise::cli
