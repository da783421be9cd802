#include "nc/iso/words.hpp"

#include "base/text.hpp"
#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::iso {
namespace {

using klartext::Lexer;

constexpr unsigned kLargestCode = 9999;
constexpr unsigned kLargestLabel = 65534;
constexpr unsigned kMostP = 99;
/// Maximum number of words in a block; a long line of them would use a multiple of its bytes.
constexpr std::size_t kMostWords = 1000;

std::string_view between(const char* begin, const char* end) {
  return trim({begin, static_cast<std::size_t>(end - begin)});
}

/// ` P02`: the next P word begins here, after a blank.
bool at_next_p(const char* at, const char* end) {
  return end - at > 2 && klartext::is_blank(at[0]) && ascii_upper(at[1]) == 'P' &&
         klartext::is_digit(at[2]);
}

void fail(Lexer& in, const char* begin, std::string message) {
  in.fail(klartext::DiagnosticCode::SyntaxError, in.place(begin, in.at()), std::move(message));
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

Word* BlockWords::find(std::string_view name) {
  const auto found = std::find_if(words.begin(), words.end(), [name](const Word& word) {
    return !word.used && word.name == name;
  });
  return found == words.end() ? nullptr : &*found;
}

std::string_view read_value(Lexer& in) {
  in.skip_blanks();
  const char* begin = in.at();
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
  in.digits(kLargestLabel, "the label");
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
