#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace fitgauge::probing {

/// A set of the control's error numbers, 1000 to 1127.
class ErrorSet {
 public:
  static constexpr int kFirst = 1000;
  static constexpr int kLast = 1127;

  constexpr ErrorSet() = default;
  constexpr ErrorSet(std::initializer_list<int> numbers) {
    for (const int number : numbers) words_.at(word(number)) |= bit(number);
  }

  constexpr bool contains(int number) const {
    if (number < kFirst || number > kLast) return false;
    return (words_.at(word(number)) & bit(number)) != 0;
  }

  friend constexpr ErrorSet operator|(ErrorSet a, const ErrorSet& b) {
    for (std::size_t k = 0; k < a.words_.size(); ++k) a.words_.at(k) |= b.words_.at(k);
    return a;
  }

 private:
  static constexpr std::size_t word(int number) {
    return static_cast<std::size_t>(number - kFirst) / 64;
  }
  static constexpr std::uint64_t bit(int number) {
    return std::uint64_t{1} << (static_cast<unsigned>(number - kFirst) % 64);
  }

  std::array<std::uint64_t, 2> words_{};
};

}  // namespace fitgauge::probing
