// Work of the library that may take long: without the interpreter's lock, and stopped by Ctrl-C.
//
// The work stays on the calling thread and touches nothing of Python's. Where it polls its progress there, signals are
// looked for twenty times a second: a handler that raises, as Ctrl-C's does, stops the work, and what it raised is
// raised here. What does not poll is waited for. Python runs handlers on its main thread alone.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "partwise/base/error.h"
#include "partwise/base/progress.h"

namespace partwise::python {

namespace py = pybind11;

// Whether a signal's handler has raised; asked from any thread, it looks on the one that made it.
class SignalWatch {
 public:
  bool stop() {
    if (stop_ || std::this_thread::get_id() != caller_ || Clock::now() < next_) return stop_;
    next_ = Clock::now() + interval;
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() == 0) return false;
    raised_.emplace();
    stop_ = true;
    return true;
  }

  // Needs the interpreter's lock.
  void raise() const {
    if (raised_) throw *raised_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr auto interval = std::chrono::milliseconds(50);

  std::thread::id caller_ = std::this_thread::get_id();
  Clock::time_point next_ = Clock::now() + interval;
  std::atomic<bool> stop_ = false;
  std::optional<py::error_already_set> raised_;
};

// Returns what `work(progress)` returns.
template <typename Work>
auto long_call(Work&& work) {
  SignalWatch watch;
  const Progress progress{.report = {}, .cancelled = [&] { return watch.stop(); }};
  const auto without_lock = [&] {
    const py::gil_scoped_release released;
    return work(progress);
  };
  try {
    auto result = without_lock();
    watch.raise();
    return result;
  } catch (const Cancelled&) {
    watch.raise();
    throw;
  }
}

}  // namespace partwise::python
