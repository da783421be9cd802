#include "nc/klartext/parser_words.hpp"

#include "nc/klartext/parser_rules.hpp"

namespace fitgauge::klartext {
namespace {

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

}  // namespace

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
  for (const MArguments& row : kMArguments) {
    if (row.m != number) continue;
    arguments_ = row.letters;
    arguments_are_bare_ = row.bare;
  }
}

Slice<Word> parse_words(BlockReader& in, LetterSet allowed, LetterSet bare, LetterSet incremental) {
  WordReader words(in, allowed, bare, incremental);
  while (!in.at_end()) words.read();
  return words.words();
}

}  // namespace fitgauge::klartext
