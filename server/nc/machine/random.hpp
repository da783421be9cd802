#pragma once

namespace fitgauge::machine {

/// xoshiro256++ (Blackman and Vigna), seeded by SplitMix64: the same numbers for the same seed on
/// every platform. Not thread-safe.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  std::uint64_t next();

  /// Mean 0, standard deviation 1: the sum of twelve even numbers in [0, 1) less 6 (Irwin-Hall).
  /// Made of integers, because std::normal_distribution and the library's log differ between
  /// platforms; never beyond ±6.
  double normal();

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace fitgauge::machine
