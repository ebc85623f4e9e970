// A program that runs beside this one. It ends with this one, however that ends; what it says on standard error is
// kept. PARTWISE_PROGRESS in its environment is the number of an open file into whose first line it may write how far
// it is.
//
// Errors: std::system_error where the system gives no process.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace partwise::pipeline {

class ChildProcess {
 public:
  // `arguments` without the name of the program.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  ~ChildProcess();  // kills it if it still runs
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  int handle() const { return handle_; }  // poll() finds it readable once the program has ended
  bool ended_within(int milliseconds) const;
  void ask_to_stop() const;

  // Waits for the end. The exit status; 128 and the signal's number where one ended it.
  int wait();

  std::string progress() const;  // "render 40 %"; empty where nothing was told

  // Of standard error so far the last line, without the name of the program.
  std::string last_line() const;

 private:
  int process_ = -1, handle_ = -1, messages_ = -1, progress_ = -1;
};

}  // namespace partwise::pipeline
