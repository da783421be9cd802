#pragma once

#include <random>

namespace fitgauge::klartext {

/// Writes random Klartext: every kind of block, in spellings that controls use, without mistakes.
class ProgramGenerator {
 public:
  explicit ProgramGenerator(std::uint64_t seed) : random_(seed) {}

  std::string program();
  /// The text with a few bytes changed, removed or doubled.
  std::string damaged(std::string text);
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(random_() % limit); }

 private:
  void expand(std::string& out, std::string_view text, int depth);

  std::mt19937_64 random_;
};

}  // namespace fitgauge::klartext
