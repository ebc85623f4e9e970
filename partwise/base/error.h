// The two ways in which a call can fail.
//
// InputError: the caller's file, mesh or setting cannot be used. Its message is one line that says where, what is wrong
// and what to do: "cow.off:12: face 7 names vertex 900, the file has 850; fix or drop the face".
// PARTWISE_CHECK: a promise that the library makes to itself does not hold; both values are printed. A bug of ours.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace partwise {

class InputError : public std::runtime_error {
 public:
  // `place` is a file, or file:line, or the name of a setting; `remedy` says what the user can do.
  InputError(const std::string& place, const std::string& problem, const std::string& remedy)
      : std::runtime_error(fmt::format("{}: {}; {}", place, problem, remedy)) {}
};

// The caller asked for a stop (Ctrl-C in the program); nothing was written.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("stopped on request") {}
};

class CheckFailed : public std::logic_error {
  using std::logic_error::logic_error;
};

}  // namespace partwise

// PARTWISE_CHECK(a, ==, b) throws CheckFailed with both expressions and both values.
#define PARTWISE_CHECK(a, op, b)                                                                                     \
  do {                                                                                                               \
    const auto& partwise_check_a = (a);                                                                              \
    const auto& partwise_check_b = (b);                                                                              \
    if (!(partwise_check_a op partwise_check_b)) {                                                                   \
      throw ::partwise::CheckFailed(fmt::format("{}:{}: check failed: {} {} {} ({} and {})", __FILE__, __LINE__, #a, \
                                                #op, #b, partwise_check_a, partwise_check_b));                       \
    }                                                                                                                \
  } while (false)
