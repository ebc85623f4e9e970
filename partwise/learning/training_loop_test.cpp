#include "partwise/learning/training_loop.h"

#include <ATen/Functions.h>
#include <ATen/TensorOperators.h>
#include <gtest/gtest.h>
#include <torch/nn/modules/linear.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "partwise/base/atomic_file.h"
#include "partwise/base/draw.h"
#include "partwise/base/error.h"
#include "partwise/base/read_bytes.h"
#include "partwise/base/test_folder.h"
#include "partwise/learning/network_blocks.h"

namespace partwise {
namespace {

// A straight line through noisy points, with dropout, so that random numbers count.
class Line final : public TrainingTask {
 public:
  Line() {
    torch::manual_seed(7);
    network_ = std::make_shared<Module>();
  }
  torch::nn::Module& network() override { return *network_; }
  WeightsFile weights() const override { return {"line", "{}"}; }
  Losses training_losses(std::int64_t step, int, const Rows& rows) override {
    if (step == stop_at) throw Cancelled();
    return losses(static_cast<std::uint64_t>(step), rows);
  }
  Losses validation_losses(std::int64_t batch, int stage, const Rows& rows) override {
    Losses result = losses(1000000 + static_cast<std::uint64_t>(batch), rows);
    if (stage > 0) result.total = result.total * later_stages_weigh;
    return result;
  }
  std::int64_t validation_batches() const override { return 2; }

  std::int64_t stop_at = -1;
  double later_stages_weigh = 1;

 private:
  struct Module : torch::nn::Module {
    Module() {
      wide = register_module("wide", connected(2, 16, 0.5));
      out = register_module("out", torch::nn::Linear(16, 1));
    }
    torch::nn::Sequential wide{nullptr};
    torch::nn::Linear out{nullptr};
  };

  Losses losses(std::uint64_t batch, const Rows& rows) {
    at::Tensor x = at::empty({rows.count, 2}), y = at::empty({rows.count, 1});
    for (std::int64_t i = 0; i < rows.count; ++i) {
      Draw draw(1, batch, static_cast<std::uint64_t>(rows.first + i));
      const double a = draw.unit(), b = draw.unit();
      x[i][0] = a;
      x[i][1] = b;
      y[i][0] = 2 * a - b + 0.1 * draw.unit();
    }
    const at::Tensor loss = (network_->out->forward(network_->wide->forward(x)) - y).square().mean();
    return {loss, {{"square", loss.item<double>()}}};
  }

  std::shared_ptr<Module> network_;
};

TrainingSettings settings(const std::filesystem::path& folder) {
  TrainingSettings result;
  result.stages = {{.steps = 17, .learning_rate = 1e-2, .final_learning_rate = 1e-3},
                   {.steps = 8, .learning_rate = 1e-3, .final_learning_rate = 1e-4, .beta1 = 0.5}};
  result.batch = 8;
  result.report_every = 4;
  result.checkpoint_every = 5;
  result.validate_every = 6;
  result.seed = 3;
  result.output = folder;
  result.configuration = "line\n";
  return result;
}

// The log without times, which differ.
std::vector<nlohmann::json> log_of(const std::filesystem::path& folder) {
  std::istringstream lines(read_bytes(folder / "log.jsonl"));
  std::vector<nlohmann::json> result;
  for (std::string line; std::getline(lines, line);) {
    result.push_back(nlohmann::json::parse(line));
    for (auto& [name, group] : result.back().items())
      if (group.is_object()) group.erase("seconds");
  }
  return result;
}

TEST(TrainingLoop, LearnsAndWritesWhatItPromises) {
  const TestFolder folder;
  Line line;
  TrainingSettings more = settings(folder.path());
  more.stages = {{.steps = 600, .learning_rate = 2e-2, .final_learning_rate = 1e-3}};
  more.report_every = 100;
  const TrainingReport report = train(line, more, {}, false);
  EXPECT_EQ(report.step, 600);
  const auto log = log_of(folder.path());
  EXPECT_GT(log.front()["validation"]["loss"].get<double>(), 4 * report.best);
  for (const char* name : {"checkpoint.pt", "best.pt", "config.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / name)) << name;
}

TEST(TrainingLoop, GoesOnWithTheSameLossesToTheBit) {
  const TestFolder whole, parts;
  Line undisturbed;
  const TrainingReport wanted = train(undisturbed, settings(whole.path()), {}, false);
  for (const std::int64_t stop : {7, 16, 19, -1}) {
    Line line;  // a process of its own would start with random parameters as well
    line.stop_at = stop;
    if (stop >= 0) {
      EXPECT_THROW(train(line, settings(parts.path()), {}, stop > 7), Cancelled);
    } else {
      const TrainingReport report = train(line, settings(parts.path()), {}, true);
      EXPECT_EQ(report.loss, wanted.loss);
      EXPECT_EQ(report.best, wanted.best);
    }
  }
  EXPECT_EQ(log_of(parts.path()), log_of(whole.path()));
}

// Stages weigh terms differently: the best of the last is told by its own losses.
TEST(TrainingLoop, TheBestIsThatOfTheStage) {
  const TestFolder folder;
  Line line;
  line.later_stages_weigh = 100;
  TrainingSettings stages = settings(folder.path());
  stages.validate_every = 4;
  const TrainingReport report = train(line, stages, {}, false);
  double least = INFINITY;
  for (const nlohmann::json& entry : log_of(folder.path())) {
    if (entry.contains("validation") && entry["step"] > 17)
      least = std::min(least, entry["validation"]["loss"].get<double>());
  }
  EXPECT_EQ(report.best, least);
}

// A process that is killed leaves the last checkpoint, and a log that is ahead of it.
TEST(TrainingLoop, GoesOnAfterBeingKilled) {
  const TestFolder whole, killed;
  Line undisturbed;
  train(undisturbed, settings(whole.path()), {}, false);
  Line line;
  line.stop_at = 13;
  const TestFolder kept;
  const Progress progress{.report =
                              [&](std::string_view, double) {
                                if (std::filesystem::exists(killed.path() / "checkpoint.pt"))
                                  std::filesystem::copy(killed.path() / "checkpoint.pt", kept.path() / "checkpoint.pt",
                                                        std::filesystem::copy_options::overwrite_existing);
                              },
                          .cancelled = {}};
  EXPECT_THROW(train(line, settings(killed.path()), {}, false, progress), Cancelled);
  std::filesystem::copy(kept.path() / "checkpoint.pt", killed.path() / "checkpoint.pt",
                        std::filesystem::copy_options::overwrite_existing);  // that of step 10
  EXPECT_EQ(log_of(killed.path()).back()["step"], 12);
  Line again;
  train(again, settings(killed.path()), {}, true);
  EXPECT_EQ(log_of(killed.path()), log_of(whole.path()));
}

TEST(TrainingLoop, RefusesWhatItCannotGoOnWith) {
  const TestFolder folder;
  Line line;
  train(line, settings(folder.path()), {}, false);
  EXPECT_THROW(train(line, settings(folder.path()), {}, false), InputError);  // without resume
  TrainingSettings other = settings(folder.path());
  other.configuration = "another\n";
  EXPECT_THROW(train(line, other, {}, true), InputError);
  const std::string bytes = read_bytes(folder.path() / "checkpoint.pt");
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, bytes.size() / 2, bytes.size() - 10}) {
    write_file(folder.path() / "checkpoint.pt", bytes.substr(0, size));
    EXPECT_THROW(train(line, settings(folder.path()), {}, true), InputError) << size;
  }
  EXPECT_THROW(train(line, settings("/proc/none"), {}, false), InputError);
  EXPECT_THROW(train(line, settings(folder.path()), {.rank = 0, .size = 3}, false), InputError);  // 8 rows for 3
}

TEST(TrainingLoop, StopsAStageThatNoLongerHelps) {
  const TestFolder folder;
  Line line;
  TrainingSettings flat = settings(folder.path());
  flat.stages = {{.steps = 1000, .learning_rate = 1e-12, .final_learning_rate = 1e-12}};
  flat.validate_every = 5;
  flat.patience = 3;
  EXPECT_LT(train(line, flat, {}, false).step, 100);
}

TEST(TrainingLoop, ALossThatIsNoNumberEndsIt) {
  const TestFolder folder;
  Line line;
  const at::NoGradGuard no_gradient;
  line.network().parameters().front().fill_(NAN);
  const at::AutoGradMode gradient(true);
  EXPECT_THROW(train(line, settings(folder.path()), {}, false), InputError);
}

// Dropout of a batch that processes share: each takes its rows of the same mask.
TEST(RowDropout, RowsOfOneMask) {
  RowDropout dropout(0.5);
  const at::Tensor ones = at::ones({6, 40});
  const auto masked = [&](const Rows& rows) {
    torch::manual_seed(5);
    take_rows(*dropout, rows);
    return dropout->forward(ones.narrow(0, rows.first, rows.count));
  };
  const at::Tensor whole = masked({0, 6, 6});
  EXPECT_TRUE(at::cat({masked({0, 2, 6}), masked({2, 4, 6})}).equal(whole));
  EXPECT_NEAR(whole.mean().item<double>(), 1, 0.2);
  EXPECT_EQ(whole.max().item<double>(), 2);
  dropout->eval();
  EXPECT_TRUE(masked({0, 6, 6}).equal(ones));
}

TEST(Weights, AreTheSameInHalfPrecision) {
  const TestFolder folder;
  const std::filesystem::path path = folder.path() / "w.pt";
  Line a, b;
  {
    const at::NoGradGuard no_gradient;
    for (at::Tensor& each : b.network().parameters()) each.fill_(0);
  }
  write_weights(path, {"line", "{\"x\": 1}"}, a.network());
  EXPECT_EQ(read_weights_header(path).kind, "line");
  EXPECT_EQ(read_weights_header(path).settings, "{\"x\": 1}");
  read_weights(path, b.network());
  for (std::size_t i = 0; i < a.network().parameters().size(); ++i)
    EXPECT_TRUE(a.network().parameters()[i].to(at::kHalf).to(at::kFloat).equal(b.network().parameters()[i]));
  const std::string bytes = read_bytes(path);
  for (std::size_t place = 0; place < bytes.size(); place += 7) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x10);
    write_file(path, damaged);
    try {
      read_weights(path, b.network());
      EXPECT_EQ(read_weights_header(path).kind, "line");  // the archive's own book-keeping was hit
      for (std::size_t i = 0; i < a.network().parameters().size(); ++i)
        ASSERT_TRUE(a.network().parameters()[i].to(at::kHalf).to(at::kFloat).equal(b.network().parameters()[i]))
            << place;
    } catch (const InputError&) {
    }
  }
  write_file(path, bytes);
  torch::nn::Linear other(3, 4);
  EXPECT_THROW(read_weights(path, *other), InputError);
}

}  // namespace
}  // namespace partwise
