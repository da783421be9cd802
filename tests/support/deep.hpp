#pragma once

namespace fitgauge {

/// How many random cases a test draws: `deep` where TESTS_DEEP is set (scripts/test --deep).
inline int rounds(int usual, int deep) {
  return std::getenv("TESTS_DEEP") == nullptr ? usual : deep;
}

/// Cases that take it minutes stay out, if one thread at a time does their work, as in shorter
/// cases of the same threads.
#ifdef __SANITIZE_THREAD__
inline constexpr bool kUnderThreadSanitizer = true;
#else
inline constexpr bool kUnderThreadSanitizer = false;
#endif

}  // namespace fitgauge
