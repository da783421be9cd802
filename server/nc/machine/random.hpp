#pragma once

namespace fitgauge::machine {

/// xoshiro256++ (Blackman and Vigna), seeded by SplitMix64: the same numbers for the same seed on
/// every platform. Not thread-safe.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_{} {
    for (std::uint64_t& word : state_) {
      seed += 0x9e3779b97f4a7c15;
      std::uint64_t mixed = seed;
      mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9;
      mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111eb;
      word = mixed ^ (mixed >> 31);
    }
  }

  std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Mean 0, standard deviation 1: the sum of twelve even numbers in [0, 1) less 6 (Irwin-Hall).
  /// Made of integers, because std::normal_distribution and the library's log differ between
  /// platforms; never beyond ±6.
  double normal() {
    constexpr int kBits = 48;
    std::uint64_t sum = 0;
    for (int term = 0; term < 12; ++term) sum += next() >> (64 - kBits);
    // Each term represents the middle of its step of 2^-48.
    const auto centred = static_cast<std::int64_t>(sum) + 6 - (std::int64_t{6} << kBits);
    return static_cast<double>(centred) / static_cast<double>(std::int64_t{1} << kBits);
  }

 private:
  std::array<std::uint64_t, 4> state_;
};

}  // namespace fitgauge::machine
