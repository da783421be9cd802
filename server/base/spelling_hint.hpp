#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fitgauge {

/// Finds the known word that is spelled most like one that is not known, without regard to case.
class SpellingHint {
 public:
  explicit SpellingHint(std::string_view word);
  void consider(std::string_view known);
  /// The known word; empty when none is near enough.
  const std::string& word() const { return best_; }
  /// "; did you mean CYCL?", or nothing when no word is near enough.
  std::string text() const;

 private:
  std::string word_;
  std::string best_;
  std::size_t distance_;
};

}  // namespace fitgauge
