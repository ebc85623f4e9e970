// Says that the processor lacks what the program was built for, in place of an illegal instruction. Compiled for any
// processor, and run before all that is not.
#include <unistd.h>

namespace {

[[gnu::constructor(101)]] void check_processor() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports(PARTWISE_PROCESSOR)) return;
  constexpr char line[] = "partwise: this processor is no " PARTWISE_PROCESSOR
                          ", which the program was built for; build it with -DPARTWISE_ARCH=x86-64\n";
  const ssize_t written = ::write(STDERR_FILENO, line, sizeof line - 1);
  static_cast<void>(written);
  ::_exit(1);
}

}  // namespace
