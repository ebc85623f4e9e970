#include "partwise/appearance/synthesis/dataset.h"

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "partwise/appearance/synthesis/dataset_folder.h"
#include "partwise/appearance/synthesis/dataset_images.h"
#include "partwise/appearance/synthesis/shard_file.h"

namespace partwise {
namespace {

// Images of one combination, or those of it that are in a shard.
struct Batch {
  int shard = 0, first = 0, count = 0;
  bool ends_shard = false;
  std::vector<NamedBytes> files{};
};

// The shards in hand, batch by batch.
class Batches {
 public:
  Batches(const DatasetConfig& config, std::vector<int> shards) : config_(config), shards_(std::move(shards)) {}

  int images() const {
    int sum = 0;
    for (const int shard : shards_) sum += end(shard) - shard * config_.images_per_shard;
    return sum;
  }

  bool next(Batch& batch) {
    if (at_ == shards_.size()) return false;
    batch.shard = shards_[at_];
    batch.first = std::max(next_, batch.shard * config_.images_per_shard);
    next_ = std::min((batch.first / config_.views + 1) * config_.views, end(batch.shard));
    batch.count = next_ - batch.first;
    batch.ends_shard = next_ == end(batch.shard);
    if (batch.ends_shard) ++at_;
    return true;
  }

 private:
  int end(int shard) const { return std::min((shard + 1) * config_.images_per_shard, config_.images); }

  const DatasetConfig& config_;
  std::vector<int> shards_;
  std::size_t at_ = 0;
  int next_ = 0;
};

// Stops all by the first thing that goes wrong. Nothing is thrown through TBB, which would leave loops within half done
// and others with what they made.
class FirstError {
 public:
  template <typename Work>
  void guard(const Work& work) {
    if (stopped_) return;
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!error_) error_ = std::current_exception();
      stopped_ = true;
    }
  }
  bool stopped() const { return stopped_; }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::atomic<bool> stopped_ = false;
  std::mutex mutex_;
  std::exception_ptr error_;
};

class ShardWriter {
 public:
  ShardWriter(const DatasetFolder& folder, DatasetReport& report) : folder_(folder), report_(report) {}

  void write(const Batch& batch) {
    if (file_ == nullptr) {
      folder_.remove_rest(batch.shard);
      file_ = std::make_unique<ShardFile>(folder_.shard(batch.shard));
    }
    for (const auto& [name, bytes] : batch.files) file_->add(name, bytes);
    report_.images += batch.count;
    if (!batch.ends_shard) return;
    file_->commit();
    file_.reset();
    ++report_.shards;
  }

 private:
  const DatasetFolder& folder_;
  DatasetReport& report_;
  std::unique_ptr<ShardFile> file_;
};

}  // namespace

DatasetReport make_dataset(const DatasetConfig& config, const Rank& rank, const Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  const DatasetFolder folder(config);
  DatasetReport report;
  std::vector<int> missing;
  for (int shard = rank.rank; shard < (config.images - 1) / config.images_per_shard + 1; shard += rank.size) {
    if (std::filesystem::exists(folder.shard(shard))) {
      ++report.skipped;
    } else {
      missing.push_back(shard);
    }
  }
  const DatasetImages images(config, folder.parts());
  Batches batches(config, std::move(missing));
  const int all = batches.images();
  ShardWriter writer(folder, report);
  FirstError error;
  const auto tokens = static_cast<std::size_t>(2 * tbb::this_task_arena::max_concurrency());
  const auto next = [&](tbb::flow_control& control) {
    auto batch = std::make_shared<Batch>();
    if (error.stopped() || !batches.next(*batch)) control.stop();
    return batch;
  };
  const auto render = [&](std::shared_ptr<Batch> batch) {
    error.guard([&] { batch->files = images.render(static_cast<std::uint64_t>(batch->first), batch->count); });
    return batch;
  };
  const auto write = [&](const std::shared_ptr<Batch>& batch) {
    error.guard([&] {
      writer.write(*batch);
      progress("rendering", static_cast<double>(report.images) / all);
    });
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(
      tokens, tbb::make_filter<void, std::shared_ptr<Batch>>(filter_mode::serial_in_order, next) &
                  tbb::make_filter<std::shared_ptr<Batch>, std::shared_ptr<Batch>>(filter_mode::parallel, render) &
                  tbb::make_filter<std::shared_ptr<Batch>, void>(filter_mode::serial_in_order, write));
  error.rethrow();
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return report;
}

}  // namespace partwise
