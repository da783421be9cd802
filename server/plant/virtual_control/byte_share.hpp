#pragma once

#include <cstddef>
#include <utility>

namespace fitgauge::virtual_control {

/// Bytes that all clients' transfers may hold together. For one thread.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t bytes) : left_(bytes) {}

 private:
  friend class ByteShare;
  std::size_t left_;
};

/// What one transfer holds of the budget; given back with it.
class ByteShare {
 public:
  explicit ByteShare(ByteBudget& budget) : budget_(&budget) {}
  ByteShare(ByteShare&& other) noexcept
      : budget_(other.budget_), taken_(std::exchange(other.taken_, 0)) {}
  ByteShare& operator=(ByteShare&& other) noexcept {
    std::swap(budget_, other.budget_);
    std::swap(taken_, other.taken_);
    return *this;
  }
  ~ByteShare() { budget_->left_ += taken_; }

  /// @returns false when there are not so many left; nothing is taken then.
  bool take(std::size_t bytes) {
    if (bytes > budget_->left_) return false;
    budget_->left_ -= bytes;
    taken_ += bytes;
    return true;
  }

 private:
  ByteBudget* budget_;
  std::size_t taken_ = 0;
};

}  // namespace fitgauge::virtual_control
