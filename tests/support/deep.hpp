#pragma once

namespace fitgauge {

/// How many random cases a test draws: `deep` where TESTS_DEEP is set (scripts/test --deep).
inline int rounds(int usual, int deep) {
  return std::getenv("TESTS_DEEP") == nullptr ? usual : deep;
}

/// Of a long case all of whose work one thread does: ThreadSanitizer has nothing to find in it and
/// takes minutes.
#ifdef __SANITIZE_THREAD__
inline constexpr bool kIsForThreads = true;
#else
inline constexpr bool kIsForThreads = false;
#endif

}  // namespace fitgauge
