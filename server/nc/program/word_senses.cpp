#include "nc/program/word_senses.hpp"

#include <algorithm>
#include <string>

#include "base/text.hpp"

namespace fitgauge::interpreter {
namespace {

struct Term {
  std::string_view word;
  unsigned senses;
};

constexpr Term kTerms[] = {
#define FITGAUGE_TERM(word, senses) {word, senses},
#include "nc/program/word_senses.inc"
#undef FITGAUGE_TERM
};

}  // namespace

unsigned senses_of(std::string_view text) {
  const std::string upper = ascii_upper(text) + ' ';
  unsigned senses = 0;
  for (std::size_t at = 0; at < upper.size(); ++at) {
    if (at != 0 && is_ascii_letter(upper[at - 1])) continue;
    const std::string_view rest = std::string_view(upper).substr(at);
    std::size_t longest = 1;
    for (const Term& term : kTerms) {
      if (rest.front() != term.word.front() || !rest.starts_with(term.word)) continue;
      senses |= term.senses;
      longest = std::max(longest, term.word.size());
    }
    at += longest - 1;
  }
  return senses;
}

bool contradict(unsigned said, unsigned meant, std::span<const unsigned> groups) {
  return std::ranges::any_of(groups, [&](unsigned group) {
    return (said & group) != 0 && (meant & group) != 0 && (said & meant & group) == 0;
  });
}

}  // namespace fitgauge::interpreter
