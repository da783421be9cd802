#include "base/spelling_hint.hpp"

#include <algorithm>
#include <vector>

#include "base/text.hpp"

namespace fitgauge {
namespace {

/// Longer words are not compared.
constexpr std::size_t kLongestWord = 40;

/// The fewest letters to put in, take out, exchange or swap with their neighbour.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> cost(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = i + j;
        continue;
      }
      const std::size_t exchange = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, exchange});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  }
  return cost[a.size()][b.size()];
}

}  // namespace

SpellingHint::SpellingHint(std::string_view word)
    : word_(ascii_upper(word)), distance_(word.size() > 4 ? 3 : 2) {}

void SpellingHint::consider(std::string_view known) {
  // One letter is near to every other.
  if (word_.size() < 2 || word_.size() > kLongestWord || known.size() < 2 ||
      known.size() > kLongestWord) {
    return;
  }
  const std::size_t distance = edits(word_, ascii_upper(known));
  if (distance >= distance_ || distance >= known.size()) return;
  distance_ = distance;
  best_ = known;
}

std::string SpellingHint::text() const {
  return best_.empty() ? std::string() : "; did you mean " + best_ + "?";
}

}  // namespace fitgauge
