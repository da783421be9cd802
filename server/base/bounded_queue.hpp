#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace fitgauge {

/// First in, first out, between threads: whoever brings an item hears at once that there is no
/// place for it, whoever takes one waits. Thread-safe.
template <class Item>
class BoundedQueue {
 public:
  using Items = std::deque<Item>;
  enum class Refusal : std::uint8_t { Full, Closed };

  /// @param limit most items that wait.
  explicit BoundedQueue(std::size_t limit) : limit_(limit) {}

  /// @returns why it was not taken; `item` is then as it was.
  [[nodiscard]] std::optional<Refusal> push(Item&& item) {
    const std::lock_guard lock(mutex_);
    if (closed_) return Refusal::Closed;
    if (items_.size() >= limit_) return Refusal::Full;
    items_.push_back(std::move(item));
    wake_.notify_one();
    return std::nullopt;
  }

  /// Waits for items, at most `patience`. Empty when none came, or none comes any more.
  Items take_all(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, patience, [this] { return !items_.empty() || closed_; });
    return std::exchange(items_, {});
  }

  /// Waits for one item; none once the queue is closed and empty.
  std::optional<Item> take_one() {
    std::unique_lock lock(mutex_);
    wake_.wait(lock, [this] { return !items_.empty() || closed_; });
    if (items_.empty()) return std::nullopt;
    return take(items_.begin());
  }

  /// Takes back the first item for which `is_it` holds; none when no such one waits.
  template <class Predicate>
  std::optional<Item> withdraw(Predicate is_it) {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(items_.begin(), items_.end(), is_it);
    if (found == items_.end()) return std::nullopt;
    return take(found);
  }

  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return items_.size();
  }

  /// What is queued can still be taken, what comes from now on is refused.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    wake_.notify_all();
  }

  /// Whether nothing is left and nothing comes any more.
  bool is_finished() const {
    const std::lock_guard lock(mutex_);
    return closed_ && items_.empty();
  }

 private:
  Item take(typename Items::iterator place) {
    Item item = std::move(*place);
    items_.erase(place);
    return item;
  }

  const std::size_t limit_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Items items_;
  bool closed_ = false;
};

}  // namespace fitgauge
