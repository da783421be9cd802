#include "nc/program/word_senses.hpp"

namespace fitgauge::interpreter {
namespace {

struct Term {
  std::string_view word;
  Senses senses = 0;
  bool is_part = false;  ///< also within a word
};

/// The terms by their first letter, the longest first.
class Terms {
 public:
  Terms() {
#define FITGAUGE_WORDS(names, words) add(interpreter::senses(names), words);
#include "nc/program/word_senses.inc"
#undef FITGAUGE_WORDS
    for (auto& terms : by_letter_)
      std::ranges::stable_sort(terms, std::greater(),
                               [](const Term& term) { return term.word.size(); });
  }

  const Term* longest(std::string_view text, bool is_in_word) const {
    for (const Term& term : by_letter_[static_cast<unsigned char>(text.front())])
      if ((term.is_part || !is_in_word) && text.starts_with(term.word)) return &term;
    return nullptr;
  }

 private:
  void add(Senses senses, std::string_view words) {
    while (!words.empty()) {
      std::string_view word = take_field(words, '|');
      const bool is_part = word.front() == '*';
      if (is_part) word.remove_prefix(1);
      by_letter_[static_cast<unsigned char>(word.front())].push_back({word, senses, is_part});
    }
  }

  std::array<std::vector<Term>, 256> by_letter_;
};

/// Senses of the part and the machining, which comments add to any parameter.
constexpr Senses kAround =
    senses("inside outside peg circle rectangle drill screw plane coordinate");
/// Senses that name no parameter without another.
constexpr Senses kAdded = senses(
    "top bottom blank finish milling retract maximum minimum position mode start step lateral");

Senses senses_of_title(const probing::CycleParameter& parameter) {
  return meant_by(parameter).title & ~kAround;
}

}  // namespace

Senses senses_of(std::string_view text) {
  static const Terms kTerms;
  const std::string upper = ascii_upper(text) + ' ';
  Senses senses = 0;
  for (std::size_t at = 0; at < upper.size(); ++at) {
    const bool is_in_word = at != 0 && is_ascii_letter(upper[at - 1]);
    const Term* term = kTerms.longest(std::string_view(upper).substr(at), is_in_word);
    if (term == nullptr) continue;
    senses |= term->senses;
    at += term->word.size() - 1;
  }
  return senses;
}

const Meant& meant_by(const probing::CycleParameter& parameter) {
  thread_local std::map<const char*, Meant> known;  // meanings are static data
  const auto [found, is_new] = known.try_emplace(parameter.meaning.data());
  if (is_new) {
    const Senses title = senses_of(parameter.title());
    found->second = {title, senses_of(parameter.meaning) & ~title};
  }
  return found->second;
}

bool contradict(Senses said, Senses meant, std::span<const Senses> groups) {
  return std::ranges::any_of(groups, [&](Senses group) {
    return (said & group) != 0 && (meant & group) != 0 && (said & meant & group) == 0;
  });
}

bool means_other(const probing::CycleDescriptor& cycle, const probing::CycleParameter& parameter,
                 std::string_view comment) {
  const bool is_title = std::ranges::any_of(
      cycle.parameters, [&](const auto& other) { return ascii_iequals(comment, other.title()); });
  const Senses said = senses_of(comment) & ~kAround;
  const Senses own = senses_of_title(parameter);
  // `CLEARANCE HEIGHT` is short for its mode.
  const bool is_short = said != 0 && said != own && (said | senses("mode")) == own;
  if (is_title && !is_short && !ascii_iequals(comment, parameter.title())) return true;
  if ((said & ~kAdded) == 0 || own == 0 || (said & ~own & ~meant_by(parameter).choices) == 0)
    return false;
  return std::ranges::any_of(cycle.parameters, [&](const probing::CycleParameter& other) {
    return (said & ~senses_of_title(other)) == 0;
  });
}

}  // namespace fitgauge::interpreter
