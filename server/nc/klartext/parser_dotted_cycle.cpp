#include "base/text.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/parser_words.hpp"

/// Sub-lines of dotted cycles. Sub-lines with only words are read strictly. The others have dialog
/// text in the language of the control (`9.1 DWELL 0.5`, `9.1 V.ZEIT 0.5`), so words and numbers
/// are picked out of it.
namespace fitgauge::klartext {
namespace {

constexpr std::uint32_t kLargestPart = 99;

/// Sub-lines (from 1) that have only these words.
struct StrictPart {
  CycleFamily family;
  unsigned number;
  unsigned part;  ///< 0: each
  LetterSet words;
  LetterSet bare = LetterSet();
  LetterSet incremental = kIncremental;
};

constexpr StrictPart kStrictParts[] = {
    {CycleFamily::CyclDef, 7, 0, kAxes | LetterSet(Letter::Row)},
    {CycleFamily::CyclDef, 8, 0, kAxes, kAxes, LetterSet()},
    {CycleFamily::CyclDef, 10, 0, LetterSet(Letter::Rot)},
    {CycleFamily::CyclDef, 11, 0, LetterSet(Letter::Scl)},
    {CycleFamily::CyclDef, 26, 0, kAxes | LetterSet(Letter::Ccx, Letter::Ccy, Letter::Ccz),
     LetterSet(), LetterSet()},
    {CycleFamily::CyclDef, 32, 1, LetterSet(Letter::T)},
    {CycleFamily::TchProbe, 0, 1, kAxes},
    {CycleFamily::TchProbe, 1, 2, kAxes},
    {CycleFamily::TchProbe, 4, 2, kAxes},
};

/// Words that are recognised within dialog text.
constexpr LetterSet kLooseWords =
    kAxes | kFeeds | LetterSet(Letter::Mb, Letter::MbMax, Letter::T, Letter::Ta);

bool at_value(BlockReader& in) {
  const char* begin = in.at();
  if (in.peek() == '+' || in.peek() == '-') in.move_to(begin + 1);
  in.skip_blanks();
  const bool value = in.at_number() || in.at_parameter();
  in.move_to(begin);
  return value;
}

/// `TCH PROBE 0.0 REF. PLANE Q5 X-`: the parameter of the result, the axis and the direction.
void parse_probing_direction(BlockReader& in) {
  while (!in.at_end() && !in.at_parameter()) in.move_to(in.at() + 1);
  in.add_word({.value = in.parameter(), .letter = Letter::Result});
  const std::optional<Letter> axis = in.at_end() ? std::nullopt : find_letter(in.letters());
  if (!axis || !is_axis(*axis)) {
    in.fail_expected("the probing axis with its direction, such as X-");
    return;
  }
  in.move_to(in.at() + 1);
  const bool minus = in.accept('-');
  if (!minus) in.expect('+');
  in.add_word({.value = minus ? -1.0 : 1.0, .letter = *axis});
}

/// A run of letters within dialog text; a word of kLooseWords or passed over.
void parse_loose_letters(BlockReader& in, bool bare_axes) {
  std::string_view name = in.letters();
  const bool incremental = name.size() == 2 && ascii_upper(name.front()) == 'I';
  const std::optional<Letter> letter = find_letter(incremental ? name.substr(1) : name);
  in.move_to(name.data() + name.size());
  const char behind = in.peek();
  if (letter == Letter::Dr && (behind == '+' || behind == '-')) {  // DR+, DR-: a direction
    in.move_to(in.at() + 1);
    in.add_word({.value = behind == '-' ? -1.0 : 1.0, .letter = Letter::Dr});
    return;
  }
  const bool part_of_text =
      behind == '.' || behind == ':' || behind == '_' || static_cast<unsigned char>(behind) >= 0x80;
  if (!letter || !kLooseWords.contains(*letter) || part_of_text) return;
  if (incremental && !is_axis(*letter)) return;
  Word word{.value = {}, .letter = *letter, .incremental = incremental};
  in.skip_blanks();
  if (is_bare(*letter) || (is_axis(*letter) && bare_axes && !at_value(in))) {
    in.add_word(word);
  } else if (at_value(in)) {
    word.value = parse_number(in);
    in.add_word(word);
  }
}

void parse_loose_part(BlockReader& in, CycleFamily family, unsigned part) {
  const bool probe = family == CycleFamily::TchProbe;
  while (!in.at_end()) {
    const char c = in.peek();
    if (probe && part == 1 && in.at_parameter()) {
      in.add_word({.value = in.parameter(), .letter = Letter::Result});
    } else if (at_value(in)) {
      in.add_word({.value = parse_number(in), .letter = Letter::Value});
    } else if (is_ascii_letter(c)) {
      parse_loose_letters(in, probe);
    } else {
      in.move_to(in.at() + 1);
    }
  }
}

void parse_part_words(BlockReader& in, CycleFamily family, unsigned number, unsigned part) {
  if (family == CycleFamily::TchProbe && number == 0 && part == 0) {
    parse_probing_direction(in);
    return;
  }
  if (part == 0) {
    in.rest();
    return;
  }
  for (const StrictPart& row : kStrictParts) {
    if (row.family == family && row.number == number && (row.part == 0 || row.part == part)) {
      parse_words(in, row.words, row.bare, row.incremental);
      return;
    }
  }
  if (family == CycleFamily::CyclDef && number == 12) {
    in.accept_word("PGM");  // some programs leave it out
    in.add_word({.value = parse_path(in), .letter = Letter::Program});
    return;
  }
  parse_loose_part(in, family, part);
}

}  // namespace

bool at_cycle_part(BlockReader& in) {
  const char* begin = in.at();
  in.skip_blanks();
  const bool part = in.peek() == '.' && is_digit(in.peek(1));
  in.move_to(begin);
  return part;
}

Statement parse_cycle_part(BlockReader& in, CycleFamily family, std::uint16_t number) {
  in.skip_blanks();
  in.expect('.');
  CyclePart cycle{.family = family, .number = number};
  cycle.part = static_cast<std::uint8_t>(in.digits(kLargestPart, "the sub-line of the cycle"));
  in.skip_blanks();
  const char* begin = in.at();
  const std::uint32_t first = in.word_count();
  parse_part_words(in, family, number, cycle.part);
  cycle.words = in.words_since(first);
  if (!in.at_end()) in.fail_expected("the end of the block");
  cycle.text = in.add_text(free_text({begin, static_cast<std::size_t>(in.at() - begin)}));
  return cycle;
}

}  // namespace fitgauge::klartext
