#include <iterator>

#include "base/text.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/parser_words.hpp"
#include "nc/klartext/statement_names.hpp"

namespace fitgauge::klartext {
namespace {

constexpr std::uint32_t kMostElements = 99;
constexpr LetterSet kPoint(Letter::X, Letter::Y, Letter::Z);
constexpr LetterSet kGrid = kPoint | LetterSet(Letter::Dx, Letter::Dy, Letter::NumX, Letter::NumY,
                                               Letter::Rot, Letter::RotX, Letter::RotY);

/// The words of each element, in the order of PatternElement.
constexpr LetterSet kElementWords[] = {
    kPoint,
    kPoint | LetterSet(Letter::D, Letter::Num, Letter::Rot),
    kGrid,
    kGrid,
    kPoint | LetterSet(Letter::D, Letter::Start, Letter::Num),
    kPoint | LetterSet(Letter::D, Letter::Start, Letter::Step, Letter::Num),
};
static_assert(std::size(kElementWords) == std::size(kPatternElements));

void parse_element(BlockReader& in) {
  const std::string_view name = in.letters();
  std::size_t kind = 0;
  while (kind < std::size(kPatternElements) && !ascii_iequals(kPatternElements[kind], name)) ++kind;
  if (kind == std::size(kPatternElements)) {
    in.fail_expected("POS, ROW, PAT, FRAME, CIRC or PITCHCIRC");
    return;
  }
  in.move_to(in.at() + name.size());
  const std::uint32_t number = in.digits(kMostElements, "the number of the element");
  in.add_word({.value = static_cast<double>(kind), .letter = Letter::Element});
  in.add_word({.value = static_cast<double>(number), .letter = Letter::Value});
  in.skip_blanks();
  in.expect('(');
  WordReader words(in, kElementWords[kind]);
  while (!in.at_end() && in.peek() != ')') words.read();
  in.expect(')');
}

}  // namespace

Statement parse_pattern(BlockReader& in) {
  in.expect_word("DEF");
  const std::uint32_t first = in.word_count();
  while (!in.at_end()) parse_element(in);
  PatternDefinition pattern{in.words_since(first)};
  if (pattern.words.count == 0) in.fail_expected("POS, ROW, PAT, FRAME, CIRC or PITCHCIRC");
  return pattern;
}

}  // namespace fitgauge::klartext
