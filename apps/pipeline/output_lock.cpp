#include "pipeline/output_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "partwise/base/error.h"

namespace partwise::pipeline {

OutputLock::OutputLock(const std::filesystem::path& output) {
  const std::filesystem::path path = output / ".lock";
  file_ = ::open(path.c_str(), O_RDWR | O_CREAT, 0666);  // children inherit it
  if (file_ < 0) {
    throw InputError(output.string(), fmt::format("cannot be written ({})", std::strerror(errno)),
                     "name an output folder that you may write to");
  }
  // The children of a pipeline that was killed may need a moment to end.
  constexpr int tries = 50;
  for (int i = 0; i < tries; ++i) {
    if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  ::close(file_);
  throw InputError(output.string(), "is being worked on by another pipeline", "wait for it, or name another folder");
}

OutputLock::~OutputLock() { ::close(file_); }

}  // namespace partwise::pipeline
