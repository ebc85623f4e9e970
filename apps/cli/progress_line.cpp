#include "progress_line.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace partwise::cli {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void on_stop(int signal) { stop_requested = signal; }

// Whoever runs this program reads there how far it is: one line, written over again and again.
void tell(int file, std::string_view stage, double done) {
  const std::string line = fmt::format("{:60.60}\n", fmt::format("{} {:.0f} %", stage, 100 * done));
  [[maybe_unused]] const auto written = ::pwrite(file, line.data(), line.size(), 0);
}

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
  const char* told = std::getenv("PARTWISE_PROGRESS");
  const int file = told == nullptr ? -1 : std::atoi(told);
  if (!visible_ && file < 0) return progress;
  using Clock = std::chrono::steady_clock;
  progress.report = [this, file, last = Clock::time_point(), last_stage = std::string()](std::string_view stage,
                                                                                         double done) mutable {
    const Clock::time_point now = Clock::now();
    if (stage == last_stage && now - last < std::chrono::milliseconds(100)) return;
    last = now;
    last_stage = stage;
    done = std::clamp(done, 0.0, 1.0);
    if (file >= 0) return tell(file, stage, done);
    fmt::print(stderr, "\r\x1b[K{:3.0f} %  {}", 100 * done, stage);
    drawn_ = true;
  };
  return progress;
}

}  // namespace partwise::cli
