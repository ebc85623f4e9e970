// One run of a verb: what every verb is given, and what it leaves behind.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "outputs.h"
#include "partwise/base/progress.h"

namespace partwise::cli {

struct Run {
  std::uint64_t seed = 0;
  int threads = 1;  // at most
  Progress progress;
  std::function<void(const std::string&)> say;  // a line on standard error
  Outputs outputs;
  std::string if_stopped = "nothing was written";                     // what a stop leaves
  std::string summary;                                                // for people, on standard output
  nlohmann::ordered_json report = nlohmann::ordered_json::object();   // for programs, --json
  nlohmann::ordered_json seconds = nlohmann::ordered_json::object();  // wall time by stage, part of the report

  // Adds `files` to the report: of each option the file that was written, if one was asked for. Returns a line of the
  // summary that names them, empty for none.
  std::string report_files(std::initializer_list<std::pair<const char*, std::string>> files) {
    std::string written;
    report["files"] = nlohmann::ordered_json::object();
    for (const auto& [option, file] : files) {
      if (file.empty()) continue;
      report["files"][option] = file;
      written += (written.empty() ? "\nwrote " : ", ") + file;
    }
    return written;
  }

  // Runs `work` as a stage: polls for Ctrl-C, adds the wall time to `seconds`, returns what `work` returns.
  template <typename Work>
  decltype(auto) stage(const std::string& name, Work&& work) {
    progress(name, 0);
    const Timer timer(seconds, name);
    return std::forward<Work>(work)();
  }

 private:
  class Timer {
   public:
    Timer(nlohmann::ordered_json& seconds, std::string name) : seconds_(seconds), name_(std::move(name)) {}
    ~Timer() {
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
      seconds_[name_] = seconds_.value(name_, 0.0) + elapsed.count();
    }
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;

   private:
    nlohmann::ordered_json& seconds_;
    std::string name_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  };
};

}  // namespace partwise::cli
