#include "partwise/learning/checkpoint.h"

#include <ATen/Functions.h>
#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>
#include <torch/csrc/jit/serialization/pickle.h>
#include <torch/nn/module.h>
#include <torch/optim/optimizer.h>
#include <torch/serialize/archive.h>

#include <exception>
#include <memory>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"

namespace partwise {
namespace {

using Tensors = c10::Dict<std::string, at::Tensor>;

// Parameters and buffers by name, as they lie in the network.
std::vector<std::pair<std::string, at::Tensor>> tensors_of(const torch::nn::Module& network) {
  std::vector<std::pair<std::string, at::Tensor>> result;
  for (const auto& each : network.named_parameters()) result.emplace_back(each.key(), each.value());
  for (const auto& each : network.named_buffers()) result.emplace_back(each.key(), each.value());
  return result;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const char* what, const char* remedy) {
  throw InputError(path.string(), fmt::format("is no {}, or is damaged or cut short", what), remedy);
}

[[noreturn]] void refuse_network(const std::filesystem::path& path, const std::string& name) {
  throw InputError(path.string(), fmt::format("is of another network: \"{}\" does not fit", name),
                   "name a file of this kind of network and size");
}

// libtorch says with many lines and exceptions of several kinds that it cannot read something.
template <typename Read>
auto reading(const std::filesystem::path& path, const char* what, const char* remedy, const Read& read) {
  try {
    return read();
  } catch (const InputError&) {
    throw;
  } catch (const std::exception&) {
    refuse(path, what, remedy);
  }
}

constexpr const char* weights_remedy = "get it again, or name a weights file that partwise train wrote";

// Whether bytes are a zip archive that holds what was put into it: libtorch does not look at checksums, and what is
// damaged may end it.
bool is_sound_archive(std::string_view bytes) {
  const std::unique_ptr<archive, decltype(&archive_read_free)> reader(archive_read_new(), &archive_read_free);
  archive_read_support_format_zip_seekable(reader.get());
  if (archive_read_open_memory(reader.get(), bytes.data(), bytes.size()) != ARCHIVE_OK) return false;
  archive_entry* entry = nullptr;
  int status = ARCHIVE_OK, entries = 0;
  for (; (status = archive_read_next_header(reader.get(), &entry)) == ARCHIVE_OK; ++entries) {
    const void* block = nullptr;
    std::size_t size = 0;
    la_int64_t offset = 0;
    do {
      status = archive_read_data_block(reader.get(), &block, &size, &offset);
    } while (status == ARCHIVE_OK);
    if (status != ARCHIVE_EOF) return false;
  }
  return status == ARCHIVE_EOF && entries > 0;
}

std::string read_archive(const std::filesystem::path& path, const char* what, const char* remedy) {
  std::string bytes = read_bytes(path);
  if (!is_sound_archive(bytes)) refuse(path, what, remedy);
  return bytes;
}

c10::Dict<c10::IValue, c10::IValue> read_whole(const std::filesystem::path& path) {
  const std::string bytes = read_archive(path, "weights file", weights_remedy);
  return reading(path, "weights file", weights_remedy, [&] {
    return torch::jit::pickle_load({bytes.begin(), bytes.end()}).toGenericDict();
  });
}

}  // namespace

void write_weights(const std::filesystem::path& path, const WeightsFile& what, const torch::nn::Module& network) {
  Tensors tensors;
  for (const auto& each : network.named_parameters()) tensors.insert(each.key(), each.value().detach().to(at::kHalf));
  for (const auto& each : network.named_buffers()) tensors.insert(each.key(), each.value().clone());
  c10::impl::GenericDict whole(c10::StringType::get(), c10::AnyType::get());
  whole.insert("kind", what.kind);
  whole.insert("settings", what.settings);
  whole.insert("tensors", tensors);
  const std::vector<char> bytes = torch::jit::pickle_save(whole);
  write_file(path, {bytes.data(), bytes.size()});
}

WeightsFile read_weights_header(const std::filesystem::path& path) {
  const auto whole = read_whole(path);
  return reading(path, "weights file", weights_remedy, [&] {
    return WeightsFile{whole.at("kind").toStringRef(), whole.at("settings").toStringRef()};
  });
}

std::string read_weights_settings(const std::filesystem::path& path, const std::string& kind) {
  const WeightsFile header = read_weights_header(path);
  if (header.kind == kind) return header.settings;
  throw InputError(path.string(), fmt::format("is a network for \"{}\"", header.kind),
                   fmt::format("give one for \"{}\"", kind));
}

void read_weights(const std::filesystem::path& path, torch::nn::Module& network) {
  const auto whole = read_whole(path);
  const auto stored =
      reading(path, "weights file", weights_remedy, [&] { return whole.at("tensors").toGenericDict(); });
  const auto wanted = tensors_of(network);
  for (const auto& [name, tensor] : wanted) {
    const auto found = stored.find(name);
    if (found == stored.end() || !found->value().isTensor() || found->value().toTensor().sizes() != tensor.sizes()) {
      refuse_network(path, name);
    }
  }
  if (stored.size() != wanted.size()) refuse_network(path, "the number of its tensors");
  const at::NoGradGuard no_gradient;
  for (const auto& [name, tensor] : wanted) tensor.copy_(stored.at(name).toTensor());
}

void write_checkpoint(const std::filesystem::path& path, const TrainingState& state, const torch::nn::Module& network,
                      const torch::optim::Optimizer& optimiser) {
  torch::serialize::OutputArchive whole, of_network, of_optimiser;
  network.save(of_network);
  optimiser.save(of_optimiser);
  whole.write("network", of_network);
  whole.write("optimiser", of_optimiser);
  whole.write("step", state.step);
  whole.write("stage", state.stage);
  whole.write("stage_step", state.stage_step);
  whole.write("best", state.best);
  whole.write("unimproved", state.unimproved);
  whole.write("sums", state.sums);
  whole.write("summed", state.summed);
  std::ostringstream bytes;
  whole.save_to(bytes);
  write_file(path, bytes.str());
}

TrainingState read_checkpoint(const std::filesystem::path& path, torch::nn::Module& network,
                              torch::optim::Optimizer& optimiser) {
  constexpr const char *what = "checkpoint of this network", *remedy = "remove it to start anew";
  std::istringstream bytes(read_archive(path, what, remedy));
  return reading(path, what, remedy, [&] {
    torch::serialize::InputArchive whole, part;
    whole.load_from(bytes);
    const auto number = [&](const char* name) {
      c10::IValue value;
      whole.read(name, value);
      return value;
    };
    TrainingState state{.step = number("step").toInt(),
                        .stage = number("stage").toInt(),
                        .stage_step = number("stage_step").toInt(),
                        .best = number("best").toDouble(),
                        .unimproved = number("unimproved").toInt(),
                        .sums = number("sums").toDoubleVector(),
                        .summed = number("summed").toInt()};
    whole.read("network", part);
    network.load(part);
    torch::serialize::InputArchive of_optimiser;
    whole.read("optimiser", of_optimiser);
    optimiser.load(of_optimiser);
    return state;
  });
}

}  // namespace partwise
