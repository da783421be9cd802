#pragma once

namespace fitgauge {

/// How many random cases a test draws: `deep` where TESTS_DEEP is set (scripts/test --deep).
inline int rounds(int usual, int deep) {
  return std::getenv("TESTS_DEEP") == nullptr ? usual : deep;
}

}  // namespace fitgauge
