#include "nc/iso/translation.hpp"

#include "nc/klartext/operator_names.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::iso {
namespace {

using enum CodeKind;

/// In the order of their numbers.
constexpr Code kCodes[] = {
    {0, Path, "L", "FMAX"},
    {1, Path, "L"},
    {2, Path, "C", "DR-"},
    {3, Path, "C", "DR+"},
    {4, Block, "CYCL DEF 9.0 DWELL TIME|CYCL DEF 9.1 DWELL $F"},
    {5, Path, "C", "DR"},
    {6, Path, "CT"},
    {7, Path, ""},
    {10, Path, "LP", "FMAX"},
    {11, Path, "LP"},
    {12, Path, "CP", "DR-"},
    {13, Path, "CP", "DR+"},
    {15, Path, "CP", "DR"},
    {16, Path, "CTP"},
    {17, Plane, "Z"},
    {18, Plane, "Y"},
    {19, Plane, "X"},
    {20, Absent, "use G17, G18 or G19 for the tool axis"},
    {24, Block, "CHF $R$w"},
    {25, Block, "RND R$R$w"},
    {26, Block, ""},
    {27, Block, ""},
    {28, Block, "CYCL DEF 8.0 MIRROR IMAGE|CYCL DEF 8.1$w"},
    {29, Block, "CC"},
    {30, Block, "BLK FORM 0.1 $a$w"},
    {31, Block, "BLK FORM 0.2$w"},
    {36, Block, "CYCL DEF 13.0 ORIENTATION|CYCL DEF 13.1 ANGLE $S"},
    {37, Block, "CYCL DEF 14.0 CONTOUR GEOMETRY|CYCL DEF 14.1 CONTOUR LABEL $p"},
    {38, Block, "STOP$w"},
    {39, Block, "CYCL DEF 12.0 PGM CALL|CYCL DEF 12.1 PGM $t"},
    {40, Compensation, "R0"},
    {41, Compensation, "RL"},
    {42, Compensation, "RR"},
    {43, Compensation, "R+"},
    {44, Compensation, "R-"},
    {50, Absent, "leave it out: it protects a file"},
    {51, Block, "TOOL DEF $T"},
    {53, Block, "CYCL DEF 7.0 DATUM SHIFT|CYCL DEF 7.1 #$1"},
    {54, Block, "CYCL DEF 7.0 DATUM SHIFT|CYCL DEF 7.1$w"},
    {55, Block, "TCH PROBE 0.0 REF. PLANE $r $2|TCH PROBE 0.1 $3"},
    {56, Absent, "use cycle G121"},
    {57, Absent, "use cycle G122"},
    {58, Absent, "use cycle G125, or G124 for finishing"},
    {59, Absent, "use cycle G125, or G124 for finishing"},
    {62, Block, "CYCL DEF 32.0 TOLERANCE|CYCL DEF 32.1$w"},
    {70, Absent, "the unit of the program stands in its first line"},
    {71, Absent, "the unit of the program stands in its first line"},
    {72, Block, "CYCL DEF 11.0 SCALING|CYCL DEF 11.1 SCL$F"},
    {73, Block, "CYCL DEF 10.0 ROTATION|CYCL DEF 10.1$w"},
    {74, Absent, "use cycle G253"},
    {75, Absent, "use cycle G251"},
    {76, Absent, "use cycle G251"},
    {77, Absent, "use cycle G252"},
    {78, Absent, "use cycle G252"},
    {79, Block, "CYCL CALL$w"},
    {80, Block, "CYCL DEF 19.0 WORKING PLANE|CYCL DEF 19.1$w"},
    {83, Absent, "use cycle G200"},
    {84, Absent, "use cycle G206"},
    {85, Absent, "use cycle G207"},
    {86, Absent, "use one of the cycles G262 to G267"},
    {90, Dimension, ""},
    {91, Dimension, "I"},
    {98, Block, "LBL $L"},
    {99, Block, "TOOL DEF $T$w"},
};

struct Function {
  unsigned number;
  std::string_view pattern;
};

constexpr Function kFunctions[] = {
    {0, "$q = $1"},     {14, "ERROR = $1"},  {15, "PRINT $p"},      {16, "F-PRINT $p"},
    {19, "PLC = $p"},   {20, "WAIT FOR $1"}, {23, "$q = CDATA $1"}, {24, "$q = CDATA $1"},
    {26, "TABOPEN $1"}, {29, "PLC = $p"},    {37, "EXPORT $p"},     {38, "SEND /$p"},
};

constexpr unsigned kFirstContourCycle = 120;
constexpr unsigned kLastContourCycle = 128;
constexpr unsigned kFirstCycle = 200;

constexpr Code kAnyCycle{0, Cycle, {}};

using klartext::Lexer;

constexpr unsigned kLargestCode = 9999;
constexpr unsigned kMostP = 99;
/// Maximum number of words in a block; a long line of them would use a multiple of its bytes.
constexpr std::size_t kMostWords = 1000;

std::string_view between(const char* begin, const char* end) {
  return trim(std::string_view(begin, end));
}

/// ` P02`: the next P word begins here, after a blank.
bool at_next_p(const char* at, const char* end) {
  return end - at > 2 && klartext::is_blank(at[0]) && ascii_upper(at[1]) == 'P' &&
         klartext::is_digit(at[2]);
}

void fail(Lexer& in, const char* begin, std::string message) {
  in.fail(klartext::DiagnosticCode::SyntaxError, in.since(begin), std::move(message));
}

/// Reads one code, after its G.
void read_code(Lexer& in, const char* begin, BlockWords& block, Modes& modes) {
  const unsigned number = in.digits(kLargestCode, "the number of the G code");
  const Code* code = find_code(number);
  if (code == nullptr) {
    return fail(
        in, begin,
        fmt::format(
            "G{:02} is unknown to these controls; docs/reference/language.md lists their codes",
            number));
  }
  if (code->kind <= CodeKind::Plane) {
    const Code* other = std::exchange(block.stated.at(static_cast<std::size_t>(code->kind)), code);
    if (other != nullptr && other != code)
      return fail(in, begin,
                  fmt::format("G{:02} and G{:02} contradict each other: leave one of them out",
                              other->number, number));
  }
  switch (code->kind) {
    case CodeKind::Absent:
      return fail(in, begin, fmt::format("G{} is not available; {}", number, code->klartext));
    case CodeKind::Path:
      modes.path = code;
      modes.path_stated = block.has_path = true;
      if (code->addition == "DR-" || code->addition == "DR+") modes.direction = code->addition;
      return;
    case CodeKind::Compensation: block.compensation = code->klartext; return;
    case CodeKind::Plane:
      modes.tool_axis = code->klartext.front();
      block.has_plane = true;
      return;
    case CodeKind::Dimension:
      modes.incremental = !code->klartext.empty();
      modes.dimension_stated = true;
      return;
    case CodeKind::Block:
    case CodeKind::Cycle: break;
  }
  if (block.block != nullptr) {
    fail(in, begin,
         fmt::format("G{:02} must not be in the block of G{:02}: write it into another block",
                     number, block.block->number));
  }
  block.block = code;
  in.accept(':');  // G79:PAT
  if (number != 39) return;
  block.text = in.rest();
  for (const std::string_view mark : {"P01", "%"}) {
    if (block.text.starts_with(mark)) block.text = trim(block.text.substr(mark.size()));
  }
}

}  // namespace

const Code* find_code(unsigned number) {
  const bool is_contour = number >= kFirstContourCycle && number <= kLastContourCycle;
  if (is_contour || number >= kFirstCycle) return &kAnyCycle;
  const auto* found = std::ranges::find(kCodes, number, &Code::number);
  return found != std::end(kCodes) ? found : nullptr;
}

std::span<const Code> codes() { return kCodes; }

std::string function_pattern(unsigned number) {
  if (const auto* row = klartext::find_arithmetic(number)) {
    return fmt::format("$q = {} {} {}", row->unary ? "" : "$1", row->sign,
                       row->unary ? "$1" : "$2");
  }
  if (number - klartext::kFirstComparison < std::size(klartext::kComparisons)) {
    return fmt::format("IF $1 {} $2 GOTO LBL $3",
                       klartext::kComparisons[number - klartext::kFirstComparison]);
  }
  const auto* row = std::ranges::find(kFunctions, number, &Function::number);
  return row != std::end(kFunctions) ? std::string(row->pattern) : std::string();
}

CycleHead cycle_head(unsigned code) {
  if (code < kFirstCycle) return {"CYCL DEF", code - (kFirstContourCycle - 20)};
  const bool probes = (code >= 400 && code < 500) || (code >= 1400 && code < 1500);
  return {probes ? "TCH PROBE" : "CYCL DEF", code};
}

Word* BlockWords::find(std::string_view name) {
  const auto found = std::find_if(words.begin(), words.end(), [name](const Word& word) {
    return !word.used && word.name == name;
  });
  return found == words.end() ? nullptr : &*found;
}

std::span<Word> BlockWords::own() {
  return {words.begin(), std::find_if(words.begin(), words.end(), [](const Word& word) {
            const auto m = word.name == "M" ? read_number<unsigned>(word.value) : std::nullopt;
            return m && klartext::has_arguments(*m);
          })};
}

std::string_view read_value(Lexer& in) {
  const char* begin = in.skip_blanks();
  const bool has_sign = in.peek() == '+' || in.peek() == '-';
  if (has_sign) in.move_to(begin + 1);
  in.skip_blanks();
  if (in.at_number()) {
    in.number();
  } else if (in.at_parameter()) {
    in.parameter();
  } else if (has_sign) {
    in.fail_expected("a number or a Q parameter");
  } else if (in.peek() == '"') {
    in.quoted();
  }
  return between(begin, in.at());
}

std::string_view read_label(Lexer& in) {
  in.skip_blanks();
  if (!klartext::is_digit(in.peek())) return read_value(in);
  const char* begin = in.at();  // the comma after it is not a decimal comma
  in.digits(klartext::kLargestLabel, "the label");
  return between(begin, in.at());
}

void read_p(Lexer& in, std::vector<std::string_view>& values) {
  while (!in.at_end()) {
    in.expect_prefix("P");
    const unsigned number = in.digits(kMostP, "the number after P");
    if (number != values.size() + 1) in.fail_expected(fmt::format("P{:02}", values.size() + 1));
    const char* begin = in.at();
    const char* at = begin;
    for (bool quoted = false; at != in.end() && (quoted || !at_next_p(at, in.end())); ++at) {
      if (*at == '"') quoted = !quoted;
    }
    in.move_to(at);
    values.push_back(between(begin, at));
  }
}

BlockWords read_words(Lexer& in, Modes& modes) {
  BlockWords block;
  while (!in.at_end()) {
    const char* begin = in.at();
    const std::string_view letters = in.letters();
    if (letters.empty()) in.fail_expected("a word of a block");
    in.move_to(in.failure() ? in.end() : begin + letters.size());
    Word word{.name = ascii_upper(letters), .value = {}, .incremental = modes.incremental};
    if (word.name == "G") {
      read_code(in, begin, block, modes);
      if (block.block != nullptr && block.block->kind == CodeKind::Cycle) return block;
      continue;
    }
    if (word.name == "P" && klartext::is_digit(in.peek())) {
      in.move_to(begin);
      read_p(in, block.p);
      break;
    }
    if (word.name == "DR" && in.peek() == '2' && (in.peek(1) == '+' || in.peek(1) == '-')) {
      in.move_to(in.at() + 1);
      word.name = "DR2";
    }
    const bool is_label = word.name == "L" && block.block != nullptr && block.block->number == 98;
    word.value = is_label ? read_label(in) : read_value(in);
    if (block.words.size() == kMostWords)
      fail(in, begin, fmt::format("a block must have at most {} words", kMostWords));
    block.words.push_back(std::move(word));
  }
  return block;
}

std::string_view effective_word(std::string_view title) {
  const char* end = title.data() + title.size();
  for (const char* at = title.data(); at != end && *at != ';' && *at != '~'; ++at) {
    if (klartext::at_cycle_parameter(at, end)) break;
    const bool begins = at == title.data() || klartext::is_blank(at[-1]);
    if (!begins || std::string_view("GMTSFXYZABCUVW").find(ascii_upper(*at)) == title.npos)
      continue;
    const char* number = std::find_if(at + 1, end, [](char c) { return c != '+' && c != '-'; });
    if (number == end || !(klartext::is_digit(*number) || *number == '.')) continue;
    const auto is_next = [&](const char& c) {
      return klartext::is_blank(c) || c == ';' || klartext::at_cycle_parameter(&c, end);
    };
    return {at, static_cast<std::size_t>(std::find_if(number, end, is_next) - at)};
  }
  return {};
}

}  // namespace fitgauge::iso
