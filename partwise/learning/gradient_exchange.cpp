#include "partwise/learning/gradient_exchange.h"

#include <ATen/Functions.h>
#include <fmt/format.h>
#include <torch/nn/module.h>
#include <torch/csrc/distributed/c10d/ProcessGroupGloo.hpp>
#include <torch/csrc/distributed/c10d/TCPStore.hpp>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "partwise/base/error.h"

namespace partwise {
namespace {

struct Place {
  std::string host;
  std::uint16_t port = 0;
};

Place meeting_place() {
  const char* host = std::getenv("MASTER_ADDR");
  const char* port = std::getenv("MASTER_PORT");
  if (host == nullptr || port == nullptr) {
    throw InputError("MASTER_ADDR and MASTER_PORT", "are not both set, and there is more than one process",
                     "set them to a host and a free port of the first process, as torchrun does");
  }
  Place place{host, 0};
  const std::string text = port;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), place.port);
  if (error != std::errc() || end != text.data() + text.size() || place.port == 0) {
    throw InputError("MASTER_PORT", fmt::format("\"{}\" is no port", text), "give a number from 1 to 65535");
  }
  return place;
}

// c10d complains in many lines.
template <typename Work>
void together(const Work& work) {
  try {
    work();
  } catch (const std::exception&) {
    throw InputError("the training's processes", "do not reach each other, or one of them has stopped",
                     "see that all are running, then go on with --resume");
  }
}

}  // namespace

struct GradientExchange::Group {
  c10::intrusive_ptr<c10d::ProcessGroupGloo> gloo;
  double size = 1;

  explicit Group(const Rank& rank) : size(rank.size) {
    const Place place = meeting_place();
    together([&] {
      c10d::TCPStoreOptions store;
      store.port = place.port;
      store.isServer = rank.rank == 0;
      store.numWorkers = static_cast<std::size_t>(rank.size);
      auto options = c10d::ProcessGroupGloo::Options::create();
      options->devices.push_back(c10d::ProcessGroupGloo::createDefaultDevice());
      gloo = c10::make_intrusive<c10d::ProcessGroupGloo>(c10::make_intrusive<c10d::TCPStore>(place.host, store),
                                                         rank.rank, rank.size, options);
    });
  }

  void average(at::Tensor& values) const {
    std::vector<at::Tensor> list = {values};
    together([&] { gloo->allreduce(list)->wait(); });
    values.div_(size);
  }
};

GradientExchange::GradientExchange(const Rank& rank)
    : group_(rank.size > 1 ? std::make_unique<Group>(rank) : nullptr) {}
GradientExchange::~GradientExchange() = default;

void GradientExchange::share_parameters(torch::nn::Module& network) {
  if (group_ == nullptr) return;
  for (const at::Tensor& each : network.parameters()) {
    std::vector<at::Tensor> list = {each.detach()};
    together([&] { group_->gloo->broadcast(list)->wait(); });
  }
}

void GradientExchange::average_gradients(torch::nn::Module& network) {
  if (group_ == nullptr) return;
  std::vector<at::Tensor> gradients;
  for (at::Tensor& each : network.parameters()) {
    if (!each.grad().defined()) each.mutable_grad() = at::zeros_like(each);
    gradients.push_back(each.grad());
  }
  std::vector<at::Tensor> flat;
  flat.reserve(gradients.size());
  for (const at::Tensor& each : gradients) flat.push_back(each.reshape({-1}));
  at::Tensor all = at::cat(flat);
  group_->average(all);
  std::int64_t offset = 0;
  for (at::Tensor& each : gradients) {
    each.copy_(all.narrow(0, offset, each.numel()).view_as(each));
    offset += each.numel();
  }
}

void GradientExchange::average(std::vector<double>& numbers) {
  if (group_ == nullptr || numbers.empty()) return;
  at::Tensor values = at::tensor(numbers, at::kDouble);
  group_->average(values);
  std::copy_n(values.data_ptr<double>(), numbers.size(), numbers.begin());
}

}  // namespace partwise
