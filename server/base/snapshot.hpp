#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

namespace fitgauge {

/// An immutable value that every thread reads and one replaces: readers keep what they took.
/// Thread-safe. A mutex and not std::atomic<std::shared_ptr>, which libstdc++ 12 implements with a
/// lock of its own that ThreadSanitizer reports as a race.
template <class T>
class Snapshot {
 public:
  explicit Snapshot(std::shared_ptr<const T> value = nullptr)
      : value_(std::move(value)), current_(value_.get()) {}

  std::shared_ptr<const T> get() const {
    const std::lock_guard lock(mutex_);
    return value_;
  }

  /// Whether `kept`, whose owner the caller is too, is still the value: without the lock.
  bool is(const T* kept) const { return current_.load(std::memory_order_acquire) == kept; }

  void set(std::shared_ptr<const T> value) {
    {
      const std::lock_guard lock(mutex_);
      value_.swap(value);
      current_.store(value_.get(), std::memory_order_release);
    }
    // The old value, if this was its last owner, is destroyed outside the lock.
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const T> value_;
  std::atomic<const T*> current_;
};

}  // namespace fitgauge
