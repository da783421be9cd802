#pragma once

/// What a target does with bytes: each defines it.
void take(std::string_view bytes);

/// Ends the process where something does not hold, which is what a fuzzer looks for.
inline void require(bool holds) {
  if (!holds) std::abort();
}
