// The verbs, in the order in which --help lists them.
#pragma once

#include <array>

#include "verb.h"

namespace partwise::cli {

extern const Verb decompose_verb;
extern const Verb evaluate_verb;
extern const Verb feature_verb;
extern const Verb segment_verb;
extern const Verb retrieve_verb;
extern const Verb medial_verb;
extern const Verb outline_verb;
extern const Verb compare2d_verb;
extern const Verb material_verb;
extern const Verb render_verb;
extern const Verb dataset_verb;

inline constexpr std::array verbs = {&decompose_verb, &feature_verb, &segment_verb, &evaluate_verb,
                                     &retrieve_verb,  &medial_verb,  &outline_verb, &compare2d_verb,
                                     &material_verb,  &render_verb,  &dataset_verb};

}  // namespace partwise::cli
