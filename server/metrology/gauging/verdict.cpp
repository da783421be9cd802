#include "metrology/gauging/verdict.hpp"

#include <array>
#include <cstddef>

namespace fitgauge::gauging {
namespace {

constexpr std::array<std::string_view, kVerdicts> kWords = {"good", "rework", "reject",
                                                            "indeterminate", "unjudged"};

}  // namespace

std::string_view word(Verdict verdict) { return kWords[static_cast<std::size_t>(verdict)]; }

std::optional<Verdict> verdict_from_word(std::string_view text) {
  for (std::size_t i = 0; i < kWords.size(); ++i) {
    if (kWords[i] == text) return static_cast<Verdict>(i);
  }
  return std::nullopt;
}

}  // namespace fitgauge::gauging
