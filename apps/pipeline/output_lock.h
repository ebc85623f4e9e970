// One pipeline at a time in an output folder. The lock ends with the program and all that it has started, however they
// end.
//
// Errors: InputError where another one works there.
#pragma once

#include <filesystem>

namespace partwise::pipeline {

class OutputLock {
 public:
  explicit OutputLock(const std::filesystem::path& output);
  ~OutputLock();
  OutputLock(const OutputLock&) = delete;
  OutputLock& operator=(const OutputLock&) = delete;

 private:
  int file_ = -1;
};

}  // namespace partwise::pipeline
