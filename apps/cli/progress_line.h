// How long work shows itself and is stopped: one line on a terminal, nothing in a pipe; Ctrl-C asks for a clean stop. A
// pipeline that runs this program (apps/pipeline/child_process.h) is told instead, whatever else was asked for.
#pragma once

#include "partwise/base/progress.h"

namespace partwise::cli {

// Takes SIGINT and SIGTERM: the first sets a flag that the Progress below polls, a second one ends the program at once.
void catch_stop_signals();

// The signal that asked for a stop, or 0.
int stop_signal();

// Draws "  42 %  cutting" on standard error and wipes it when destroyed. Silent unless standard error is a terminal.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  // Valid as long as this line is.
  Progress progress();
  void wipe();

 private:
  bool visible_;
  bool drawn_ = false;
};

}  // namespace partwise::cli
