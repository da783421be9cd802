#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

/// Cycles in Q-form. Their block is read line by line: each physical line may end with a comment
/// (the dialog text) and a wrap.
namespace fitgauge::klartext {
namespace {

/// Reads the free text after the cycle's number: up to the first parameter, a comment or line end.
Text parse_dialog(BlockReader& in) {
  const char* begin = in.at();
  const char* at = begin;
  while (at != in.end() && *at != ';' && *at != '\n' && !at_cycle_parameter(at, in.end())) ++at;
  in.move_to(at);
  return in.add_text(without_wrap(std::string_view(begin, at)));
}

/// Adds the comment from `;` to the end of its physical line to `comment`, and passes it.
void parse_line_comment(BlockReader& in, Text& comment) {
  const char* begin = in.at() + 1;
  const char* end = std::find(begin, in.end(), '\n');
  in.move_to(end);
  const std::string_view text = without_wrap(std::string_view(begin, end));
  if (comment.empty()) {
    comment = in.add_text(text);
  } else if (!text.empty()) {
    // The comment is the last text of the pool: it grows in place.
    comment.size += in.add_text(" ").size + in.add_text(text).size;
  }
}

/// Blanks, wraps and line ends between the parameters.
void skip_lines(BlockReader& in) {
  in.skip_blanks();
  // A `~` before the comment: the following indented lines belong to the cycle.
  if (in.peek() == '~' && in.peek(1) != '~') {
    const char* behind = std::find_if_not(in.at() + 1, in.end(), is_blank);
    if (behind != in.end() && *behind == ';') in.move_to(behind);
  }
  while (in.peek() == '\n') {
    in.move_to(in.at() + 1);
    in.skip_blanks();
  }
}

void parse_cycle_value(BlockReader& in, CycleParameter& parameter) {
  in.skip_blanks();
  if (in.peek() == '"') {
    parameter.value = in.quoted_text(kLongestString, "the text");
  } else if (in.accept_word("FAUTO") || in.accept_word("AUTO")) {
    parameter.kind = CycleValue::Auto;
  } else if (in.accept_word("PREDEF")) {
    parameter.kind = CycleValue::Predef;
  } else if (in.accept_prefix("FU")) {
    parameter.kind = CycleValue::Fu;
    parameter.value = parse_number(in);
  } else if (in.accept_prefix("FZ")) {
    parameter.kind = CycleValue::Fz;
    parameter.value = parse_number(in);
  } else if (in.accept_word("FMAX") || in.accept_word("MAX") ||
             (in.accept_prefix("F") && in.accept_word("MAX"))) {
    parameter.kind = CycleValue::Max;
  } else {
    parameter.value = parse_value(in);
  }
}

/// Parameters with their comments up to the end of the block. A comment before the first parameter
/// is the block's.
Slice<CycleParameter> parse_parameters(BlockReader& in) {
  auto& pool = in.cycle_parameters();
  const auto first = static_cast<std::uint32_t>(pool.size());
  for (skip_lines(in); in.at() != in.end(); skip_lines(in)) {
    const char* begin = in.at();
    if (*begin == ';') {
      parse_line_comment(in, pool.size() > first ? pool.back().comment : in.block_comment());
      continue;
    }
    CycleParameter parameter;
    parameter.parameter = in.parameter();
    in.expect('=');
    parse_cycle_value(in, parameter);
    parameter.written = in.since(begin);
    const auto repeated = std::any_of(pool.begin() + first, pool.end(), [&](const auto& earlier) {
      return earlier.parameter.number == parameter.parameter.number;  // Q330 and QS330 are one
    });
    if (repeated && !in.failure()) {
      in.fail(DiagnosticCode::CycleParameterRepeated, parameter.written,
              "this parameter is repeated in the cycle");
    }
    pool.push_back(parameter);
  }
  return {first, static_cast<std::uint32_t>(pool.size()) - first};
}

constexpr LetterSet kCallWords = kFeeds | LetterSet(Letter::M);

Statement parse_cycle_call(BlockReader& in) {
  CycleCall call;
  LetterSet words = kCallWords;
  if (in.accept_word("PAT")) call.kind = CycleCallKind::Pattern;
  if (in.accept_word("POS")) {
    call.kind = CycleCallKind::Position;
    words = kCallWords | kAxes;
  }
  call.words = parse_words(in, words);
  return call;
}

// Sub-lines of dotted cycles. Sub-lines with only words are read strictly. The others have dialog
// text in the language of the control (`9.1 DWELL 0.5`, `9.1 V.ZEIT 0.5`), so words and numbers are
// picked out of it.

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
  const std::optional<Axis> axis = in.at_end() ? std::nullopt : parse_axis_alone(in);
  if (!axis) {
    in.fail_expected("the probing axis with its direction, such as X-");
    return;
  }
  const bool minus = in.accept('-');
  if (!minus) in.expect('+');
  in.add_word({.value = minus ? -1.0 : 1.0, .letter = letter_of(*axis)});
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
  const bool part_of_text = (behind == '.' && !in.at_number()) || behind == ':' || behind == '_' ||
                            static_cast<unsigned char>(behind) >= 0x80;
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

Statement parse_cycle_part(BlockReader& in, CycleFamily family, std::uint16_t number) {
  in.skip_blanks();
  in.expect('.');
  CyclePart cycle{.family = family, .number = number};
  cycle.part = static_cast<std::uint8_t>(in.digits(kLargestPart, "the sub-line of the cycle"));
  const char* begin = in.skip_blanks();
  const std::uint32_t first = in.word_count();
  parse_part_words(in, family, number, cycle.part);
  cycle.words = in.words_since(first);
  if (!in.at_end()) in.fail_expected("the end of the block");
  cycle.text = in.add_text(free_text(std::string_view(begin, in.at())));
  return cycle;
}

Statement parse_cycle(BlockReader& in, CycleFamily family) {
  in.skip_blanks();
  Cycle cycle{.family = family};
  cycle.number = static_cast<std::uint16_t>(in.digits(kLargestCycle, "the number of the cycle"));
  if (family != CycleFamily::GlobalDef && at_cycle_part(in))
    return parse_cycle_part(in, family, cycle.number);
  cycle.dialog = parse_dialog(in);
  cycle.parameters = parse_parameters(in);
  return cycle;
}

}  // namespace

bool at_cycle_parameter(const char* at, const char* end) {
  if (at == end || ascii_upper(*at) != 'Q') return false;
  ++at;
  if (at != end && ascii_upper(*at) == 'S') ++at;
  const char* digits = at;
  at = std::find_if_not(at, end, is_digit);
  if (at == digits) return false;
  at = std::find_if_not(at, end, is_blank);
  return at != end && *at == '=';
}

Statement parse_cycl(BlockReader& in) {
  if (in.accept_word("CALL")) return parse_cycle_call(in);
  if (in.accept_joined("DEF")) return parse_cycle(in, CycleFamily::CyclDef);
  return in.fail_expected("CALL or DEF");
}

Statement parse_global(BlockReader& in) {
  in.expect_word("DEF");
  return parse_cycle(in, CycleFamily::GlobalDef);
}

Statement parse_tch_probe(BlockReader& in) {
  in.expect_joined("PROBE");
  return parse_cycle(in, CycleFamily::TchProbe);
}

bool at_cycle_part(BlockReader& in) {
  const char* begin = in.at();
  in.skip_blanks();
  const bool part = in.peek() == '.' && is_digit(in.peek(1));
  in.move_to(begin);
  return part;
}

}  // namespace fitgauge::klartext
