// Makes models/networks/vgg16_start.pt, the start of VGG-16 for the perceptual loss, from eight text files.
//
//   vgg16_start DIR OUT.pt
//
// DIR holds new_blockB_convC.txt, a weight a line, and bias_blockB_convC.txt, 16 binary digits a bias, for B and C of 1
// and 2. Weights come in tiles of 64 x 64 channels: for each tile of outputs, tile of inputs, and place of the 3 x 3, a
// row of outputs for each input. Biases are in two's complement with 12 to 14 binary places. Exits 0, 1 when it cannot
// be done, 2 for wrong usage.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "bench/tool.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/learning/checkpoint.h"
#include "partwise/learning/vgg16_start.h"

namespace {

using partwise::InputError;

constexpr int tile = 64, kernel = 9, digits = 16;

void read_kernel(const std::filesystem::path& path, int inputs, int outputs, float* kernels) {
  std::istringstream lines(partwise::read_bytes(path));
  const int tile_inputs = std::min(inputs, tile), tiles = (inputs + tile - 1) / tile;
  for (int out_tile = 0; out_tile < outputs / tile; ++out_tile)
    for (int in_tile = 0; in_tile < tiles; ++in_tile)
      for (int place = 0; place < kernel; ++place)
        for (int in = 0; in < tile_inputs; ++in)
          for (int out = 0; out < tile; ++out) {
            const int row = out_tile * tile + out, column = in_tile * tile + in;
            if (!(lines >> kernels[(row * inputs + column) * kernel + place]))
              throw InputError(path.string(), "holds too few weights", "get it again");
          }
}

void read_biases(const std::filesystem::path& path, int places, int outputs, float* biases) {
  const std::string text = partwise::read_bytes(path);
  for (int i = 0; i < outputs; ++i) {
    const std::string word = text.substr(std::min(text.size(), static_cast<std::size_t>(i) * digits), digits);
    if (word.size() != digits || word.find_first_not_of("01") != std::string::npos)
      throw InputError(path.string(), fmt::format("bias {} is no 16 binary digits", i), "get it again");
    biases[i] = std::ldexp(static_cast<float>(static_cast<std::int16_t>(std::stoi(word, nullptr, 2))), -places);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder, out;
  CLI::App app("The start of VGG-16 as a weights file");
  app.add_option("folder", folder, "of the text files")->required();
  app.add_option("out", out, "weights file (.pt)")->required();
  return partwise::bench::run_tool("vgg16_start", app, argc, argv, [&] {
    constexpr std::array<int, 4> binary_places = {12, 13, 14, 14};
    partwise::Vgg16Start start;
    for (int i = 0; i < 4; ++i) {
      const std::string name = fmt::format("block{}_conv{}.txt", i / 2 + 1, i % 2 + 1);
      const auto index = static_cast<std::size_t>(i);
      read_kernel(std::filesystem::path(folder) / ("new_" + name), start.channels[index], start.channels[index + 1],
                  start.kernels[index].data_ptr<float>());
      read_biases(std::filesystem::path(folder) / ("bias_" + name), binary_places[index], start.channels[index + 1],
                  start.biases[index].data_ptr<float>());
    }
    partwise::write_weights(out, {partwise::vgg16_start_kind, "{}"}, start);
    return 0;
  });
}
