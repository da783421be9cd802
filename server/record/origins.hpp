#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

namespace fitgauge::app {

/// What the ids of each data folder end with whose records stand here: 16 hexadecimal digits.
/// Number 0 is this folder. Thread-safe; what was given out stays valid.
class Origins {
 public:
  std::string_view own() const { return digits(0); }

  /// Empty for a number that is not known.
  std::string_view digits(std::int64_t number) const {
    const std::lock_guard lock(mutex_);
    const auto found = digits_.find(number);
    return found == digits_.end() ? std::string_view() : found->second;
  }

  std::optional<std::int64_t> number(std::string_view digits) const {
    const std::lock_guard lock(mutex_);
    const auto found = numbers_.find(digits);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

  void remember(std::int64_t number, std::string_view digits) {
    const std::lock_guard lock(mutex_);
    const auto [at, is_new] = digits_.try_emplace(number, digits);
    if (is_new) numbers_.emplace(at->second, number);
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::int64_t, std::string> digits_;
  std::map<std::string, std::int64_t, std::less<>> numbers_;
};

}  // namespace fitgauge::app
