// The values that were asked for last, as many as fit into so many bytes. For many threads: two that miss the same
// value at once both make it, so nobody waits for another. Internal to this room.
#pragma once

#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

namespace partwise {

template <typename Key, typename Value>
class RecentValues {
 public:
  explicit RecentValues(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // make() gives a shared pointer, whose value's bytes() says how much room it takes; what alone is too large is not
  // kept.
  template <typename Make>
  std::shared_ptr<const Value> get(const Key& key, const Make& make) {
    if (std::shared_ptr<const Value> found = find(key)) return found;
    std::shared_ptr<const Value> value = make();
    keep(key, value, value->bytes());
    return value;
  }

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Value> value;
    std::size_t bytes;
  };

  std::shared_ptr<const Value> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    const auto found = places_.find(key);
    if (found == places_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->value;
  }

  void keep(const Key& key, std::shared_ptr<const Value> value, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    if (places_.contains(key) || bytes > most_bytes_) return;
    entries_.push_front({key, std::move(value), bytes});
    places_[key] = entries_.begin();
    bytes_ += bytes;
    while (bytes_ > most_bytes_) {
      bytes_ -= entries_.back().bytes;
      places_.erase(entries_.back().key);
      entries_.pop_back();
    }
  }

  std::mutex mutex_;
  std::list<Entry> entries_;  // the last one asked for first
  std::map<Key, typename std::list<Entry>::iterator> places_;
  std::size_t most_bytes_, bytes_ = 0;
};

}  // namespace partwise
