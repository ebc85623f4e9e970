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
  const std::filesystem::path here = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const std::string program = (here / "partwise-learning").string();
  ::execv(program.c_str(), arguments);
  const int why = errno;
  if (why == ENOENT) {
    fmt::print(
        stderr,
        "partwise: {} needs libtorch, and this copy was built without; configure it with -DPARTWISE_LEARNING=ON\n",
        arguments[1]);
  } else {
    fmt::print(stderr, "partwise: {} cannot be run: {}; install partwise again\n", program, std::strerror(why));
  }
  return 1;
}

}  // namespace partwise::cli
