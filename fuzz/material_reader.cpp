// What libFuzzer calls: one reader of measured materials, chosen by PARTWISE_FUZZ_FORMAT. MERL's tables are of one
// size, which fuzzing would never reach: the bytes are read as they are, and once more with what is missing of a whole
// file behind them. Whatever the bytes, the outcome is a material or an InputError of one line.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/outcome.h"
#include "partwise/appearance/material/merl.h"
#include "partwise/appearance/material/neural_brdf.h"

namespace {

using namespace partwise;
using namespace partwise::fuzz;

constexpr std::string_view format = PARTWISE_FUZZ_FORMAT;
constexpr std::size_t whole = 12 + 24 * static_cast<std::size_t>(merl_bins);

void read_table(std::string_view bytes) {
  const MerlTable table = decode_merl("fuzz", bytes);
  if (bytes.size() != whole) give_up("a table of another size");
  for (int bin = 0; bin < 1024; ++bin) {  // where the bytes are
    if (!table.value(bin).allFinite()) give_up("a value that is not finite");
  }
}

void read_network(std::string_view bytes) {
  const NeuralBrdf network = decode_neural_brdf("fuzz", bytes);
  if (network({0, 0, 1}, {0.6f, 0, 0.8f}).minCoeff() < 0) give_up("a value below zero");
}

void expect_material_or_message(std::string_view bytes) {
  expect_message_or([&] { format == "h5" ? read_network(bytes) : read_table(bytes); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  expect_material_or_message(bytes);
  if (format == "binary" && size >= 12 && size < whole) {
    bytes.resize(whole);
    expect_material_or_message(bytes);
  }
  return 0;
}
