// The verbs of partwise.
#include "verbs.h"

#include <array>

#include "learning_verbs.h"

namespace partwise::cli {

namespace {
constexpr std::array list = {&decompose_verb, &feature_verb, &segment_verb,   &evaluate_verb, &retrieve_verb,
                             &medial_verb,    &outline_verb, &compare2d_verb, &cage_verb,     &deform_verb,
                             &repair_verb,    &unfold_verb,  &material_verb,  &render_verb,   &dataset_verb,
                             &rooms_verb,     &roadmap_verb, &plan_verb,      &pipeline_verb};
}

std::span<const Verb* const> verbs() { return list; }
std::span<const LearningVerb> verbs_elsewhere() { return learning_verbs; }

}  // namespace partwise::cli
