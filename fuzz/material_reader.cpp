// What libFuzzer calls: the reader of MERL tables. Tables are of one size, which fuzzing would never reach: the bytes
// are read as they are, and once more with what is missing of a whole file behind them. Whatever the bytes, the outcome
// is a table of finite numbers or an InputError of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "partwise/appearance/material/merl.h"
#include "partwise/base/error.h"

namespace {

using namespace partwise;

constexpr std::size_t whole = 12 + 24 * static_cast<std::size_t>(merl_bins);

[[noreturn]] void give_up(const char* what) {
  std::fprintf(stderr, "%s\n", what);
  std::abort();
}

void expect_table_or_message(std::string_view bytes) {
  try {
    const MerlTable table = decode_merl("fuzz", bytes);
    if (bytes.size() != whole) give_up("a table of another size");
    for (int bin = 0; bin < 1024; ++bin) {  // where the bytes are
      if (!table.value(bin).allFinite()) give_up("a value that is not finite");
    }
  } catch (const InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) give_up("a message of several lines");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  expect_table_or_message(bytes);
  if (size >= 12 && size < whole) {
    bytes.resize(whole);
    expect_table_or_message(bytes);
  }
  return 0;
}
