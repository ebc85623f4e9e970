#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>

namespace partwise::cli {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void on_stop(int signal) { stop_requested = signal; }

}  // namespace

void catch_stop_signals() {
  struct sigaction action = {};
  action.sa_handler = on_stop;
  action.sa_flags = SA_RESETHAND;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

int stop_signal() { return stop_requested; }

ProgressLine::ProgressLine(bool quiet) : visible_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

ProgressLine::~ProgressLine() { wipe(); }

void ProgressLine::wipe() {
  if (drawn_) fmt::print(stderr, "\r\x1b[K");
  drawn_ = false;
}

Progress ProgressLine::progress() {
  Progress progress;
  progress.cancelled = [] { return stop_requested != 0; };
  if (!visible_) return progress;
  using Clock = std::chrono::steady_clock;
  progress.report = [this, last = Clock::time_point(), last_stage = std::string()](std::string_view stage,
                                                                                   double done) mutable {
    const Clock::time_point now = Clock::now();
    if (stage == last_stage && now - last < std::chrono::milliseconds(100)) return;
    last = now;
    last_stage = stage;
    fmt::print(stderr, "\r\x1b[K{:3.0f} %  {}", 100 * std::clamp(done, 0.0, 1.0), stage);
    drawn_ = true;
  };
  return progress;
}

}  // namespace partwise::cli
