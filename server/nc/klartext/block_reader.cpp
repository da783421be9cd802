#include "nc/klartext/block_reader.hpp"

#include "nc/klartext/parser_rules.hpp"
#include "tables/tabfile/characters.hpp"

namespace fitgauge::klartext {
namespace {

/// Parentheses and functions within each other; the parser itself calls a few functions for each.
constexpr int kDeepestNesting = 100;

/// Words that are nothing but a letter and a number.
constexpr LetterSet kPlain = kAxes | LetterSet(Letter::F);

/// The words that belong to an M function when they follow it.
struct MArguments {
  unsigned m;
  LetterSet letters;
  bool bare = false;  ///< axes without a value
};

constexpr MArguments kMArguments[] = {
    {.m = 94, .letters = kAxes, .bare = true},
    {.m = 103, .letters = LetterSet(Letter::F)},
    {.m = 118, .letters = kAxes},
    {.m = 120, .letters = LetterSet(Letter::La)},
    {.m = 124, .letters = LetterSet(Letter::T)},
    {.m = 128, .letters = kFeeds},
    {.m = 138, .letters = kAxes, .bare = true},
    {.m = 140, .letters = LetterSet(Letter::Mb, Letter::MbMax) | kFeeds},
    {.m = 197, .letters = LetterSet(Letter::Dl)},
};

constexpr std::uint32_t kLargestM = 9999;

const MArguments* arguments_of(unsigned m) {
  const auto row = std::ranges::find(kMArguments, m, &MArguments::m);
  return row == std::end(kMArguments) ? nullptr : &*row;
}

}  // namespace

bool has_arguments(unsigned m) { return arguments_of(m) != nullptr; }

void BlockReader::open(std::size_t begin, std::size_t end) {
  Lexer::open(begin, end);
  at_open_ = {parts_.words.size(), parts_.cycle_parameters.size(), parts_.nodes.size(),
              parts_.operands.size(), parts_.texts.size()};
  comment_ = {};
  depth_ = 0;
}

void BlockReader::drop_block() {
  parts_.words.resize(at_open_.words);
  parts_.cycle_parameters.resize(at_open_.cycle_parameters);
  parts_.nodes.resize(at_open_.nodes);
  parts_.operands.resize(at_open_.operands);
  parts_.texts.resize(at_open_.texts);
}

Text BlockReader::add_text(std::string_view text) {
  if (text.empty()) return {};
  const auto first = static_cast<std::uint32_t>(parts_.texts.size());
  parts_.texts += text;
  return {first, static_cast<std::uint32_t>(text.size())};
}

Text BlockReader::quoted_text(std::size_t longest, std::string_view what) {
  const char* begin = at();
  const std::string_view characters = quoted();
  const std::size_t count = tabfile::count_characters(characters);
  const auto control = std::find_if(characters.begin(), characters.end(),
                                    [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  if (control != characters.end()) {
    fail(DiagnosticCode::ControlCharacter, place(begin, at()),
         fmt::format("{} holds a control character", what));
  } else if (count > longest) {
    fail(DiagnosticCode::StringTooLong, place(begin, at()),
         fmt::format("{} has {} characters; at most {} are allowed", what, count, longest));
  }
  return add_text(characters);
}

Expr BlockReader::add_node(Operator op, std::span<const Expr> operands) {
  int height = 0;
  for (const Expr& operand : operands) {
    if (const auto* index = std::get_if<NodeIndex>(&operand))
      height = std::max<int>(height, parts_.nodes[index->value].height);
  }
  if (height >= kDeepestExpression)
    return fail(
        DiagnosticCode::ExpressionTooDeep, here(),
        fmt::format("the formula has more than {} steps in a chain: split it into several blocks",
                    kDeepestExpression));
  const auto index = static_cast<std::uint32_t>(parts_.nodes.size());
  const Slice<Expr> slice = add_operands(operands);
  parts_.nodes.push_back({op, static_cast<std::uint16_t>(height + 1), slice});
  return NodeIndex{index};
}

Slice<Expr> BlockReader::add_operands(std::span<const Expr> operands) {
  const auto first = static_cast<std::uint32_t>(parts_.operands.size());
  parts_.operands.insert(parts_.operands.end(), operands.begin(), operands.end());
  return {first, static_cast<std::uint32_t>(operands.size())};
}

bool BlockReader::is_string(const Expr& expr) const {
  const auto* index = std::get_if<NodeIndex>(&expr);
  return index != nullptr ? gives_text(parts_.nodes[index->value].op) : is_text(expr);
}

void BlockReader::enter() {
  if (++depth_ > kDeepestNesting) {
    fail(DiagnosticCode::ExpressionTooDeep, here(),
         fmt::format("more than {} nested parentheses or functions: split the formula",
                     kDeepestNesting));
  }
}

WordReader::WordReader(BlockReader& in, LetterSet allowed, LetterSet bare, LetterSet incremental)
    : in_(in),
      allowed_(allowed),
      bare_(bare),
      incremental_(incremental),
      plain_(allowed & kPlain),
      first_(in.word_count()) {}

Word WordReader::parse_name() {
  Word word;
  if (in_.accept('#')) {
    word.letter = Letter::Row;
    return word;
  }
  std::string_view name = in_.letters();
  if (ascii_iequals(name, "P") && is_digit(in_.peek(1)) && is_ascii_letter(in_.peek(2))) {
    name = {in_.at(), 3};  // P1X
  }
  std::optional<Letter> letter = find_letter(name);
  if (!letter && name.size() > 1 && ascii_upper(name.front()) == 'I') {
    letter = find_letter(name.substr(1));
    word.incremental = letter && kIncremental.contains(*letter);
    if (!word.incremental) letter.reset();
  }
  if (!letter) return in_.fail_expected(in_.at_end() ? "a word" : "a word of this block");
  word.letter = *letter;
  in_.move_to(name.data() + name.size());
  return word;
}

/// Reads words such as `X+10.5`, the form of nearly all words of a long program, without the
/// detours of the general way. Stops before a word of another form. @returns whether there was one.
bool WordReader::read_plain_words() {
  const char* at = in_.at();
  const char* behind = at;
  for (;;) {
    const Letter letter = single_letter(*at);
    if (!plain_.contains(letter)) break;
    const char sign = at[1];
    double value = 0;
    const char* number = at + (sign == '+' || sign == '-' ? 2 : 1);
    const char* end = scan_plain_number(number, in_.source_end(), value);
    if (end == nullptr) break;
    in_.add_word({.value = sign == '-' ? -value : value, .letter = letter});
    plain_.erase(letter);
    seen_.insert(letter);
    behind = end;
    at = end;
    while (is_blank(*at)) ++at;
  }
  const bool found = behind != in_.at();
  in_.move_to(behind);
  return found;
}

void WordReader::read() {
  in_.skip_blanks();
  if (read_plain_words()) return;
  const char* begin = in_.at();
  Word word = parse_name();
  if (in_.failure()) return;
  parse_value_of(word);
  word.argument = arguments_.contains(word.letter);
  if (word.incremental && (word.argument || !incremental_.contains(word.letter))) {
    in_.fail(
        DiagnosticCode::SyntaxError, in_.since(begin),
        fmt::format("{} must not have I here: write the absolute value", spelling(word.letter)));
  }
  if (!word.argument) {
    if (!allowed_.contains(word.letter)) {
      in_.fail(DiagnosticCode::SyntaxError, in_.since(begin),
               fmt::format("{} is not allowed in this block", spelling(word.letter)));
    }
    // F100 and FMAX are two values of one word.
    const Letter letter = kFeeds.contains(word.letter) ? Letter::F : word.letter;
    if (seen_.contains(letter) && letter != Letter::M) {
      in_.fail(DiagnosticCode::WordRepeated, in_.since(begin),
               fmt::format("{} is repeated in this block", spelling(letter)));
    }
    seen_.insert(letter);
    plain_.erase(letter);
  }
  in_.add_word(word);
}

void WordReader::parse_value_of(Word& word) {
  switch (word.letter) {
    case Letter::M: parse_m_number(word); return;
    case Letter::F:
      if (in_.accept_word("MAX")) word.letter = Letter::FMax;
      if (in_.accept_word("AUTO")) word.letter = Letter::FAuto;
      break;
    case Letter::Mb:
      if (in_.accept_word("MAX")) word.letter = Letter::MbMax;
      break;
    case Letter::Dr:
      // `DR2+0.1` is the radius of the corner; the number 2 alone would need a sign.
      if (in_.peek() == '2' && !is_digit(in_.peek(1)) && in_.peek(1) != '.') {
        in_.move_to(in_.at() + 1);
        word.letter = Letter::Dr2;
      }
      break;
    default: break;
  }
  if (is_bare(word.letter)) return;
  in_.skip_blanks();
  const char c = in_.peek();
  const bool value_follows = c == '+' || c == '-' || in_.at_number() || in_.at_parameter();
  const bool may_be_bare =
      bare_.contains(word.letter) || (arguments_are_bare_ && arguments_.contains(word.letter));
  if (!value_follows && may_be_bare) return;
  word.value = parse_number(in_);
}

void WordReader::parse_m_number(Word& word) {
  const std::uint32_t number = in_.digits(kLargestM, "the number of the M function");
  if (in_.peek() == '.' && !is_digit(in_.peek(1))) in_.move_to(in_.at() + 1);  // `M128.`
  word.value = static_cast<double>(number);
  arguments_ = LetterSet();
  // After an M function, the general way separates its arguments from words of the block.
  plain_ = LetterSet();
  if (const MArguments* row = arguments_of(number); row != nullptr) {
    arguments_ = row->letters;
    arguments_are_bare_ = row->bare;
  }
}

Slice<Word> parse_words(BlockReader& in, LetterSet allowed, LetterSet bare, LetterSet incremental) {
  WordReader words(in, allowed, bare, incremental);
  while (!in.at_end()) words.read();
  return words.words();
}

}  // namespace fitgauge::klartext
