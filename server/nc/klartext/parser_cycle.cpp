#include "base/text.hpp"
#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"
#include "nc/klartext/parser_words.hpp"

/// Cycles in Q-form. Their block is read line by line: each physical line may end with a comment
/// (the dialog text) and a wrap.
namespace fitgauge::klartext {
namespace {

constexpr std::uint32_t kLargestCycle = 9999;

/// Reads the free text after the cycle's number: up to the first parameter, the comment or the line
/// end.
Text parse_dialog(BlockReader& in) {
  const char* begin = in.at();
  const char* at = begin;
  while (at != in.end() && *at != ';' && *at != '\n' && !at_cycle_parameter(at, in.end())) ++at;
  in.move_to(at);
  return in.add_text(without_wrap({begin, static_cast<std::size_t>(at - begin)}));
}

/// Adds the comment from `;` to the end of its physical line to `comment`; the lexer moves behind
/// it.
void parse_line_comment(BlockReader& in, Text& comment) {
  const char* begin = in.at() + 1;
  const char* end = std::find(begin, in.end(), '\n');
  in.move_to(end);
  const std::string_view text = without_wrap({begin, static_cast<std::size_t>(end - begin)});
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
    parameter.written = in.place(begin, in.at());
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

Statement parse_cycle(BlockReader& in, CycleFamily family) {
  in.skip_blanks();
  Cycle cycle{.family = family};
  cycle.number = static_cast<std::uint16_t>(in.digits(kLargestCycle, "the number of the cycle"));
  if (family != CycleFamily::GlobalDef && at_cycle_part(in)) {
    return parse_cycle_part(in, family, cycle.number);
  }
  cycle.dialog = parse_dialog(in);
  cycle.parameters = parse_parameters(in);
  return cycle;
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
  return expected(in, "CALL or DEF");
}

Statement parse_global(BlockReader& in) {
  in.expect_word("DEF");
  return parse_cycle(in, CycleFamily::GlobalDef);
}

Statement parse_tch_probe(BlockReader& in) {
  in.expect_joined("PROBE");
  return parse_cycle(in, CycleFamily::TchProbe);
}

}  // namespace fitgauge::klartext
