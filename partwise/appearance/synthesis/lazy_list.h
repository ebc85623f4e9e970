// Values that are made when they are first asked for, once, by whoever asks first; who asks meanwhile lends a hand.
// Internal to this room.
#pragma once

#include <oneapi/tbb/collaborative_call_once.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>

namespace partwise {

template <typename Value>
class LazyList {
 public:
  // What make(i) throws is thrown to whoever asks; the next to ask tries again.
  LazyList(std::size_t size, std::function<Value(int)> make)
      : slots_(std::make_unique<Slot[]>(size)), make_(std::move(make)) {}

  const Value& operator[](int i) const {
    Slot& slot = slots_[static_cast<std::size_t>(i)];
    tbb::collaborative_call_once(slot.once, [&] { slot.value.emplace(make_(i)); });
    return *slot.value;
  }

 private:
  struct Slot {
    tbb::collaborative_once_flag once;
    std::optional<Value> value;
  };
  std::unique_ptr<Slot[]> slots_;
  std::function<Value(int)> make_;
};

}  // namespace partwise
