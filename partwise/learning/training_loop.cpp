#include "partwise/learning/training_loop.h"

#include <ATen/Functions.h>
#include <fmt/format.h>
#include <torch/nn/module.h>
#include <torch/nn/utils/clip_grad.h>
#include <torch/optim/adam.h>
#include <torch/utils.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "partwise/base/atomic_file.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/splitmix.h"
#include "partwise/learning/checkpoint.h"
#include "partwise/learning/gradient_exchange.h"
#include "partwise/learning/network_blocks.h"
#include "partwise/learning/training_log.h"

namespace partwise {
namespace {

constexpr double beta2 = 0.999;

Rows rows_of(const TrainingSettings& settings, const Rank& rank) {
  if (settings.stages.empty() || settings.batch < 1) {
    throw InputError("the training", "has no stages or no rows in a batch", "give one or more of each");
  }
  if (settings.batch % rank.size != 0) {
    throw InputError("batch", fmt::format("{} rows cannot be shared evenly by {} processes", settings.batch, rank.size),
                     "change one of them");
  }
  const std::int64_t count = settings.batch / rank.size;
  return {rank.rank * count, count, settings.batch};
}

class Training {
 public:
  Training(TrainingTask& task, const TrainingSettings& settings, const Rank& rank)
      : task_(task),
        settings_(settings),
        first_(rank.rank == 0),
        rows_(rows_of(settings, rank)),
        exchange_(rank),
        optimiser_(task.network().parameters(), torch::optim::AdamOptions(settings.stages.front().learning_rate)) {}

  TrainingReport run(bool resume, const Progress& progress) {
    start(resume);
    try {
      while (!done()) {
        progress("train", static_cast<double>(state_.step) / static_cast<double>(planned_steps()));
        step();
      }
    } catch (const Cancelled&) {
      save();
      throw;
    }
    report();
    save();
    return {state_.step, last_loss_, state_.best};
  }

 private:
  std::filesystem::path file(const char* name) const { return settings_.output / name; }
  bool done() const { return state_.stage == static_cast<std::int64_t>(settings_.stages.size()); }
  const TrainingStage& stage() const { return settings_.stages[static_cast<std::size_t>(state_.stage)]; }

  std::int64_t planned_steps() const {
    std::int64_t all = state_.step - state_.stage_step;
    for (auto i = static_cast<std::size_t>(state_.stage); i < settings_.stages.size(); ++i)
      all += settings_.stages[i].steps;
    return all;
  }

  void start(bool resume) {
    std::error_code error;
    std::filesystem::create_directories(settings_.output, error);
    if (error) throw InputError(settings_.output.string(), "cannot be made", "name another folder");
    const bool there = std::filesystem::exists(file("checkpoint.pt"));
    if (there && !resume) {
      throw InputError(settings_.output.string(), "holds a training already", "add --resume, or name another folder");
    }
    if (there) {
      if (read_bytes(file("config.json")) != settings_.configuration) {
        throw InputError(settings_.output.string(), "holds a training of another configuration", "name another folder");
      }
      state_ = read_checkpoint(file("checkpoint.pt"), task_.network(), optimiser_);
    } else if (first_) {
      write_file(file("config.json"), settings_.configuration);
    }
    exchange_.share_parameters(task_.network());
    if (first_) log_ = std::make_unique<TrainingLog>(settings_.output, state_.step);
    since_ = std::chrono::steady_clock::now();
    skip_empty_stages();
  }

  void skip_empty_stages() {
    while (!done() && state_.stage_step >= stage().steps) next_stage();
  }

  // What is best is told anew: stages weigh the terms of their loss each in its own way.
  void next_stage() {
    ++state_.stage;
    if (done()) return;
    state_.best = std::numeric_limits<double>::infinity();
    state_.stage_step = state_.unimproved = 0;
  }

  // Random numbers from here on depend on the seed and the step alone.
  void set_random_state(std::uint64_t number) const {
    torch::manual_seed(splitmix(splitmix(settings_.seed + splitmix_step) + number));
  }

  double learning_rate() const {
    const double share = static_cast<double>(state_.stage_step) / static_cast<double>(stage().steps);
    return stage().learning_rate * std::pow(stage().final_learning_rate / stage().learning_rate, share);
  }

  void step() {
    auto& options = static_cast<torch::optim::AdamOptions&>(optimiser_.param_groups().front().options());
    options.lr(learning_rate()).betas({stage().beta1, beta2});
    task_.network().train();
    take_rows(task_.network(), rows_);
    set_random_state(static_cast<std::uint64_t>(state_.step));
    const Losses losses = task_.training_losses(state_.step, static_cast<int>(state_.stage), rows_);
    optimiser_.zero_grad();
    losses.total.backward();
    exchange_.average_gradients(task_.network());
    const double length = torch::nn::utils::clip_grad_norm_(task_.network().parameters(), settings_.largest_gradient);
    note(losses, length);
    optimiser_.step();
    ++state_.step;
    ++state_.stage_step;
    if (state_.step % settings_.report_every == 0) report();
    if (state_.step % settings_.validate_every == 0 || state_.stage_step == stage().steps) validate();
    skip_empty_stages();
    if (state_.step % settings_.checkpoint_every == 0) save();
  }

  void note(const Losses& losses, double gradient) {
    std::vector<double> values = values_of(losses);
    values.push_back(gradient);
    if (!std::isfinite(values.front()) || !std::isfinite(gradient)) {
      throw InputError("the training", fmt::format("the loss of step {} is not a number any more", state_.step),
                       "lower the learning rate, then go on from the last checkpoint with --resume");
    }
    names_ = names_of(losses);
    names_.emplace_back("gradient");
    state_.sums.resize(values.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) state_.sums[i] += values[i];
    ++state_.summed;
  }

  std::vector<double> values_of(const Losses& losses) {
    std::vector<double> values = {losses.total.item<double>()};
    for (const auto& [name, value] : losses.terms) values.push_back(value);
    exchange_.average(values);
    return values;
  }

  static std::vector<std::string> names_of(const Losses& losses) {
    std::vector<std::string> names = {"loss"};
    for (const auto& [name, value] : losses.terms) names.push_back(name);
    return names;
  }

  void report() {
    if (state_.summed == 0) return;
    const auto now = std::chrono::steady_clock::now();
    nlohmann::ordered_json line;
    for (std::size_t i = 0; i < names_.size(); ++i)
      line[names_[i]] = state_.sums[i] / static_cast<double>(state_.summed);
    last_loss_ = line["loss"];
    if (!done()) line["learning_rate"] = learning_rate();
    line["seconds"] = std::chrono::duration<double>(now - since_).count();
    if (log_ != nullptr) log_->add(state_.step, "training", line);
    state_.sums.clear();
    state_.summed = 0;
    since_ = now;
  }

  void validate() {
    task_.network().eval();
    const at::NoGradGuard no_gradient;
    std::vector<double> sums;
    std::vector<std::string> names;
    const std::int64_t batches = task_.validation_batches();
    for (std::int64_t batch = 0; batch < batches; ++batch) {
      const Losses losses = task_.validation_losses(batch, static_cast<int>(state_.stage), rows_);
      const std::vector<double> values = values_of(losses);
      names = names_of(losses);
      sums.resize(values.size(), 0);
      for (std::size_t i = 0; i < values.size(); ++i) sums[i] += values[i] / static_cast<double>(batches);
    }
    if (batches == 0) return;
    nlohmann::ordered_json line;
    for (std::size_t i = 0; i < sums.size(); ++i) line[names[i]] = sums[i];
    if (log_ != nullptr) log_->add(state_.step, "validation", line);
    judge(sums.front());
  }

  void judge(double loss) {
    if (loss < state_.best) {
      state_.best = loss;
      state_.unimproved = 0;
      if (first_) write_weights(file("best.pt"), task_.weights(), task_.network());
    } else if (++state_.unimproved >= settings_.patience && settings_.patience > 0) {
      next_stage();
    }
  }

  void save() {
    if (first_) write_checkpoint(file("checkpoint.pt"), state_, task_.network(), optimiser_);
  }

  TrainingTask& task_;
  const TrainingSettings& settings_;
  bool first_;
  Rows rows_;
  GradientExchange exchange_;
  torch::optim::Adam optimiser_;
  TrainingState state_;
  std::unique_ptr<TrainingLog> log_;
  std::vector<std::string> names_;
  double last_loss_ = 0;
  std::chrono::steady_clock::time_point since_;
};

}  // namespace

TrainingReport train(TrainingTask& task, const TrainingSettings& settings, const Rank& rank, bool resume,
                     const Progress& progress) {
  return Training(task, settings, rank).run(resume, progress);
}

}  // namespace partwise
