#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "learning_verbs.h"

namespace partwise::cli {

int become_learning_program(char** arguments) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  // Beside this program; where it cannot be known (/proc is not mounted), wherever programs are.
  const std::string program = error ? "partwise-learning" : (self.parent_path() / "partwise-learning").string();
  ::execvp(program.c_str(), arguments);
  const int why = errno;
  if (why == ENOENT) {
    fmt::print(
        stderr,
        "partwise: {} needs the program partwise-learning, which is not there; install the package of that name, "
        "or configure with -DPARTWISE_LEARNING=ON\n",
        arguments[1]);
  } else {
    fmt::print(stderr, "partwise: {} cannot be run: {}; install partwise again\n", program, std::strerror(why));
  }
  return 1;
}

}  // namespace partwise::cli
