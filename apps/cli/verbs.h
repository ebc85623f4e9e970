// All verbs, and those of the program that this is linked with, in the order in which --help lists them.
#pragma once

#include <span>

#include "verb.h"

namespace partwise::cli {

extern const Verb decompose_verb;
extern const Verb feature_verb;
extern const Verb segment_verb;
extern const Verb evaluate_verb;
extern const Verb retrieve_verb;
extern const Verb medial_verb;
extern const Verb outline_verb;
extern const Verb compare2d_verb;
extern const Verb cage_verb;
extern const Verb deform_verb;
extern const Verb repair_verb;
extern const Verb unfold_verb;
extern const Verb material_verb;
extern const Verb render_verb;
extern const Verb dataset_verb;
extern const Verb rooms_verb;
extern const Verb train_verb;
extern const Verb edit_verb;
extern const Verb normals_verb;
extern const Verb roadmap_verb;
extern const Verb plan_verb;
extern const Verb pipeline_verb;

std::span<const Verb* const> verbs();

}  // namespace partwise::cli
