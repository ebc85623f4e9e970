#include "pipeline/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <string_view>
#include <system_error>
#include <utility>

namespace partwise::pipeline {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

// The C library's own wrapper cannot be linked from C++ before glibc 2.37.
int handle_of(pid_t process) { return static_cast<int>(::syscall(SYS_pidfd_open, process, 0)); }

// In the child, between fork and exec: only what signal handlers may do.
[[noreturn]] void become(const char* program, char* const* arguments, char* const* environment, int messages,
                         int parent) {
  constexpr int cannot_run = 127;
  // A parent that is killed takes its children along: nobody else may work in their folders until they are gone.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(cannot_run);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(nothing, STDOUT_FILENO);
  ::dup2(messages, STDERR_FILENO);
  ::execve(program, arguments, environment);
  constexpr char text[] = "the program cannot be run; install it again\n";
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, sizeof(text) - 1);
  ::_exit(cannot_run);
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& each : texts) pointers.push_back(each.data());
  pointers.push_back(nullptr);
  return pointers;
}

std::string all_of(int file) {
  std::string text;
  char block[4096];
  for (;;) {
    const ssize_t got = ::pread(file, block, sizeof(block), static_cast<off_t>(text.size()));
    if (got <= 0) return text;
    text.append(block, static_cast<std::size_t>(got));
  }
}

}  // namespace

ChildProcess::ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {program.filename().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  messages_ = ::memfd_create("messages", MFD_CLOEXEC);
  progress_ = ::memfd_create("progress", 0);
  if (messages_ < 0 || progress_ < 0) fail("memfd_create");
  std::vector<std::string> variables = {"PARTWISE_PROGRESS=" + std::to_string(progress_)};
  for (char** each = environ; *each != nullptr; ++each) variables.emplace_back(*each);
  const std::vector<char*> arguments_of = pointers_to(words), environment = pointers_to(variables);
  const int parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) become(program.c_str(), arguments_of.data(), environment.data(), messages_, parent);
  if (process_ > 0) handle_ = handle_of(process_);
  if (process_ > 0 && handle_ >= 0) return;
  const int why = errno;
  ::close(messages_);
  ::close(progress_);
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  errno = why;
  fail("a process");
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)),
      handle_(std::exchange(other.handle_, -1)),
      messages_(std::exchange(other.messages_, -1)),
      progress_(std::exchange(other.progress_, -1)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(process_, other.process_);
  std::swap(handle_, other.handle_);
  std::swap(messages_, other.messages_);
  std::swap(progress_, other.progress_);
  return *this;
}

ChildProcess::~ChildProcess() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait();
  }
  for (const int file : {handle_, messages_, progress_}) {
    if (file >= 0) ::close(file);
  }
}

bool ChildProcess::ended_within(int milliseconds) const {
  pollfd end{handle_, POLLIN, 0};
  return ::poll(&end, 1, milliseconds) > 0;
}

void ChildProcess::ask_to_stop() const {
  if (process_ > 0) ::kill(process_, SIGTERM);
}

int ChildProcess::wait() {
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  constexpr int by_signal = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : by_signal + WTERMSIG(status);
}

std::string ChildProcess::progress() const {
  const std::string line = all_of(progress_);
  return line.substr(0, line.find_last_not_of(" \n") + 1);
}

std::string ChildProcess::last_line() const {
  constexpr std::string_view name = "partwise: ";
  std::string line = all_of(messages_);
  while (line.ends_with('\n')) line.pop_back();
  line.erase(0, line.rfind('\n') + 1);
  if (line.starts_with(name)) line.erase(0, name.size());
  return line;
}

}  // namespace partwise::pipeline
