#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fitgauge::gauging {

/// What becomes of a part. Rework: a hole too small or a shaft too large, more can be cut. Reject:
/// a hole too large or a shaft too small. Indeterminate: too near a limit for the uncertainty.
/// Unjudged: a value without limits.
enum class Verdict : std::uint8_t { Good, Rework, Reject, Indeterminate, Unjudged };
inline constexpr std::size_t kVerdicts = 5;

/// `good`, `rework`, `reject`, `indeterminate`, `unjudged`.
std::string_view word(Verdict verdict);
std::optional<Verdict> verdict_from_word(std::string_view text);

}  // namespace fitgauge::gauging
