// Networks in files, by libtorch's archives.
//
// A weights file holds what kind of network it is, its settings as JSON, its parameters in half precision, which is as
// good for use, and its buffers as they are. A checkpoint holds parameters, the state of an optimiser, and where a
// training stood. Both appear whole or not at all. Errors: InputError for a file
// that cannot be read or written, is damaged, is no such file, or is of another network.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace torch::nn {
class Module;
}
namespace torch::optim {
class Optimizer;
}

namespace partwise {

struct WeightsFile {
  std::string kind;      // what the network is for
  std::string settings;  // JSON
};

void write_weights(const std::filesystem::path& path, const WeightsFile& what, const torch::nn::Module& network);
WeightsFile read_weights_header(const std::filesystem::path& path);
// The settings of a file of this kind. Errors: InputError for one of another kind as well.
std::string read_weights_settings(const std::filesystem::path& path, const std::string& kind);
void read_weights(const std::filesystem::path& path, torch::nn::Module& network);

// Where a training stands.
struct TrainingState {
  std::int64_t step = 0;                                  // steps done
  std::int64_t stage = 0, stage_step = 0;                 // the stage it is in, and steps done in it
  double best = std::numeric_limits<double>::infinity();  // validation loss
  std::int64_t unimproved = 0;                            // validations of this stage since then
  std::vector<double> sums;                               // of the losses since the last report
  std::int64_t summed = 0;                                // steps in them
};

void write_checkpoint(const std::filesystem::path& path, const TrainingState& state, const torch::nn::Module& network,
                      const torch::optim::Optimizer& optimiser);
TrainingState read_checkpoint(const std::filesystem::path& path, torch::nn::Module& network,
                              torch::optim::Optimizer& optimiser);

}  // namespace partwise
