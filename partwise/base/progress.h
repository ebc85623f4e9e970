// Progress and cancellation of long work, as the caller wishes to see it.
//
// Every long function takes a `const Progress&` last. The default one is silent and never cancels. Calls may come from
// one thread at a time only.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
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

// The progress of a parallel loop over `all` items: whoever comes first reports for all, the others go on.
class SharedProgress {
 public:
  SharedProgress(const Progress& progress, std::string_view stage, int all)
      : progress_(progress), stage_(stage), all_(all) {}

  void add(int count) {
    done_ += count;
    if (!mutex_.try_lock()) return;
    const std::lock_guard lock(mutex_, std::adopt_lock);
    progress_(stage_, static_cast<double>(done_) / all_);
  }

 private:
  const Progress& progress_;
  std::string_view stage_;
  int all_;
  std::atomic<int> done_ = 0;
  std::mutex mutex_;
};

}  // namespace partwise
