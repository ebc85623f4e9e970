// Verbs that need libtorch live in a program of their own, partwise-learning, which partwise runs in its place: loading
// libtorch takes half a second, which nobody who wants hulls should wait for.
#pragma once

#include <array>
#include <span>

namespace partwise::cli {

struct LearningVerb {
  const char* name;
  const char* summary;
};

inline constexpr LearningVerb train_line = {"train",
                                            "Train a network from a configuration, with checkpoints; --resume goes on"};

inline constexpr LearningVerb edit_line = {"edit",
                                           "One photo of an object in, the same object in another material out"};

inline constexpr LearningVerb normals_line = {"normals", "One photo of an object in, the normals of its surface out"};

inline constexpr std::array learning_verbs = {train_line, edit_line, normals_line};

// Those that the program at hand leaves to the other one.
std::span<const LearningVerb> verbs_elsewhere();

// Becomes partwise-learning with the same arguments. Returns only where that cannot be done: says why, returns the exit
// status.
int become_learning_program(char** arguments);

}  // namespace partwise::cli
