#include "pipeline/job_runner.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <exception>
#include <memory>
#include <set>
#include <utility>

#include "partwise/base/error.h"
#include "pipeline/child_process.h"
#include "pipeline/job_order.h"

namespace partwise::pipeline {
namespace {

using Clock = std::chrono::steady_clock;
using State = JobResult::State;

std::string what_went_wrong(const ChildProcess& child, int status) {
  constexpr int by_signal = 128;
  if (status > by_signal) {
    const int signal = status - by_signal;
    return fmt::format(
        "was ended by signal {}; {}", signal,
        signal == SIGKILL ? "if memory is short, run fewer jobs at a time with --threads" : "run the pipeline again");
  }
  const std::string line = child.last_line();
  return line.empty() ? fmt::format("ended with {} and said nothing; run it by itself", status) : line;
}

class Runner {
 public:
  Runner(const Workplace& place, const std::vector<Job>& jobs, int threads, FileHashes& hashes, const JobEvents& events,
         const Progress& progress)
      : place_(place),
        jobs_(jobs),
        threads_(threads),
        hashes_(hashes),
        events_(events),
        progress_(progress),
        before_(jobs_before(jobs, place.output)),
        after_(jobs.size()),
        missing_(jobs.size()),
        folders_(jobs.size()),
        results_(jobs.size()) {
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      missing_[i] = before_[i].size();
      for (const std::size_t other : before_[i]) after_[other].push_back(i);
      if (missing_[i] == 0) ready_.insert(i);
    }
  }

  std::vector<JobResult> run() {
    try {
      for (;;) {
        settle();
        start();
        if (running_.empty()) break;
        wait_for_some();
      }
    } catch (const Cancelled&) {
      stop();
      throw;
    }
    return std::move(results_);
  }

 private:
  struct Running {
    std::size_t job;
    int threads;
    Clock::time_point start;
    ChildProcess child;
  };

  void show() const {
    std::string now;
    if (!running_.empty()) {
      const Running& oldest = running_.front();
      const std::string part = oldest.child.progress();
      now = jobs_[oldest.job].name + (part.empty() ? "" : ", " + part);
      if (running_.size() > 1) now += fmt::format(", and {} beside it", running_.size() - 1);
    }
    progress_(fmt::format("{} of {} jobs{}{}", finished_, jobs_.size(), now.empty() ? "" : ": ", now),
              static_cast<double>(finished_) / static_cast<double>(std::max<std::size_t>(1, jobs_.size())));
  }

  // Of all whose inputs are there: which stand, and which are to be made.
  void settle() {
    while (!ready_.empty()) {
      const std::size_t job = *ready_.begin();
      ready_.erase(ready_.begin());
      show();
      try {
        if (!do_without_failed(job)) continue;
        folders_[job] = std::make_unique<JobFolder>(place_, jobs_[job], hashes_);
        if (folders_[job]->reason().empty()) {
          results_[job].record = folders_[job]->record();
          finish(job, State::kept);
        } else {
          to_make_.insert(job);
        }
      } catch (const InputError& error) {
        fail(job, error.what());
      }
    }
  }

  // False if it cannot.
  bool do_without_failed(std::size_t job) {
    std::set<std::string> failed;
    for (const std::size_t other : before_[job]) {
      const State state = results_[other].state;
      if (state == State::failed || state == State::held) failed.insert(jobs_[other].name);
    }
    if (failed.empty()) return true;
    if (jobs_[job].without) {
      jobs_[job] = jobs_[job].without(failed);
      return true;
    }
    results_[job].message = *failed.begin();
    finish(job, State::held);
    return false;
  }

  void start() {
    while (!to_make_.empty()) {
      const std::size_t job = *to_make_.begin();
      const int used = used_threads(), free = threads_ - used;
      const bool wide = jobs_[job].wide;
      if (!running_.empty() && (wide || free < 1)) return;
      int share = threads_;
      if (!wide) share = std::max(1, free / std::clamp(static_cast<int>(to_make_.size()), 1, std::max(1, free)));
      if (jobs_[job].threads > 0) share = jobs_[job].threads;
      to_make_.erase(to_make_.begin());
      spawn(job, share);
    }
  }

  int used_threads() const {
    int used = 0;
    for (const Running& each : running_) used += jobs_[each.job].wide ? threads_ : each.threads;
    return used;
  }

  void spawn(std::size_t job, int threads) {
    try {
      if (events_.begins) events_.begins(jobs_[job]);
      JobFolder& folder = *folders_[job];
      std::vector<std::string> words = folder.begin(here_);
      for (const std::string& each : {std::string("--quiet"), std::string("--json"), folder.report().string(),
                                      std::string("--threads"), std::to_string(threads)}) {
        words.push_back(each);
      }
      running_.push_back({job, threads, Clock::now(), ChildProcess(place_.program, words)});
    } catch (const std::exception& error) {
      fail(job, error.what());
    }
  }

  void wait_for_some() {
    constexpr int milliseconds = 100;
    std::vector<pollfd> handles;
    for (const Running& each : running_) handles.push_back({each.child.handle(), POLLIN, 0});
    ::poll(handles.data(), handles.size(), milliseconds);
    show();
    for (std::size_t i = handles.size(); i-- > 0;) {
      if ((handles[i].revents & POLLIN) == 0) continue;
      Running ended = std::move(running_[i]);
      running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
      end(ended);
    }
  }

  void end(Running& ended) {
    const int status = ended.child.wait();
    const std::chrono::duration<double> seconds = Clock::now() - ended.start;
    results_[ended.job].seconds = seconds.count();
    JobFolder& folder = *folders_[ended.job];
    if (status != 0) {
      folder.give_up();
      return fail(ended.job, what_went_wrong(ended.child, status));
    }
    try {
      folder.finish(here_, seconds.count());
      results_[ended.job].record = folder.record();
      finish(ended.job, State::made);
    } catch (const std::exception& error) {
      fail(ended.job, error.what());
    }
  }

  void fail(std::size_t job, const std::string& message) {
    results_[job].message = message;
    if (events_.fails) events_.fails(jobs_[job], message);
    finish(job, State::failed);
  }

  void finish(std::size_t job, State state) {
    results_[job].state = state;
    folders_[job].reset();
    ++finished_;
    for (const std::size_t other : after_[job]) {
      if (--missing_[other] == 0) ready_.insert(other);
    }
  }

  // Those that are done all the same are kept.
  void stop() {
    for (const Running& each : running_) each.child.ask_to_stop();
    for (Running& each : running_) {
      if (each.child.wait() != 0) continue;
      try {
        const std::chrono::duration<double> seconds = Clock::now() - each.start;
        folders_[each.job]->finish(here_, seconds.count());
      } catch (const std::exception&) {  // it will be made again
      }
    }
  }

  const Workplace& place_;
  std::vector<Job> jobs_;
  int threads_;
  FileHashes& hashes_;
  const JobEvents& events_;
  const Progress& progress_;
  const std::filesystem::path here_ = std::filesystem::current_path();
  std::vector<std::vector<std::size_t>> before_, after_;
  std::vector<std::size_t> missing_;  // how many of those before are not finished
  std::set<std::size_t> ready_, to_make_;
  std::vector<std::unique_ptr<JobFolder>> folders_;
  std::vector<Running> running_;
  std::vector<JobResult> results_;
  std::size_t finished_ = 0;
};

}  // namespace

std::vector<JobResult> run_jobs(const Workplace& place, const std::vector<Job>& jobs, int threads, FileHashes& hashes,
                                const JobEvents& events, const Progress& progress) {
  return Runner(place, jobs, threads, hashes, events, progress).run();
}

std::vector<JobForecast> forecast_jobs(const Workplace& place, const std::vector<Job>& jobs, FileHashes& hashes) {
  const auto before = jobs_before(jobs, place.output);
  std::vector<JobForecast> result(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto unsettled = std::ranges::find_if(
        before[i], [&](std::size_t other) { return result[other].state != JobForecast::State::kept; });
    if (unsettled != before[i].end()) {
      result[i].reason = jobs[*unsettled].name;
      continue;
    }
    result[i].reason = JobFolder(place, jobs[i], hashes).reason();
    result[i].state = result[i].reason.empty() ? JobForecast::State::kept : JobForecast::State::made;
  }
  return result;
}

}  // namespace partwise::pipeline
