#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <utility>

namespace fitgauge::http {

/// Counts who has a Place inside, and lets one wait until all have left. Thread-safe.
class Gate {
 public:
  std::uint64_t inside() const {
    const std::lock_guard lock(mutex_);
    return inside_;
  }

  /// @returns false when somebody is still inside after `timeout`.
  bool wait_until_empty(std::chrono::milliseconds timeout) {
    std::unique_lock lock(mutex_);
    return empty_.wait_for(lock, timeout, [this] { return inside_ == 0; });
  }

 private:
  friend class Place;
  void enter() {
    const std::lock_guard lock(mutex_);
    ++inside_;
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    if (--inside_ == 0) empty_.notify_all();
  }

  mutable std::mutex mutex_;
  std::condition_variable empty_;
  std::uint64_t inside_ = 0;
};

/// Whoever has it is inside the gate, which outlives it.
class Place {
 public:
  explicit Place(Gate& gate) : gate_(&gate) { gate_->enter(); }
  Place(Place&& other) noexcept : gate_(std::exchange(other.gate_, nullptr)) {}
  Place& operator=(Place&&) = delete;
  ~Place() {
    if (gate_) gate_->leave();
  }

 private:
  Gate* gate_;
};

}  // namespace fitgauge::http
