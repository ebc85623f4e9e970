// Progress and cancellation of long work, as the caller wishes to see it.
//
// Every long function takes a `const Progress&` last. The default one is silent and never cancels. Calls may come from
// one thread at a time only.
#pragma once

#include <functional>
#include <string_view>

#include "partwise/base/error.h"

namespace partwise {

struct Progress {
  // stage, and the part of the stage that is done in [0, 1].
  std::function<void(std::string_view stage, double done)> report;
  // True once the work should stop; the next call of operator() then throws Cancelled.
  std::function<bool()> cancelled;

  void operator()(std::string_view stage, double done) const {
    if (cancelled && cancelled()) throw Cancelled();
    if (report) report(stage, done);
  }
};

}  // namespace partwise
