#include "nc/klartext/lexer.hpp"

namespace fitgauge::klartext {
namespace {

bool continues_word(char c) { return is_ascii_letter(c) || is_digit(c) || c == '_'; }

/// Literals have at most nine digits before the point.
constexpr double kLargestNumber = 1e9;

/// Returns the end of the wrap that starts at `~`, after its line end; `at` if there is no wrap.
const char* wrap_end(const char* at, const char* end) {
  const char* next = std::find_if_not(at + 1, end, is_blank);
  return next != end && *next == '\n' ? next + 1 : at;
}

/// The physical lines of a text with `seam` instead of each wrap.
std::string joined(std::string_view text, std::string_view seam) {
  std::string out;
  out.reserve(text.size());
  const char* end = text.data() + text.size();
  for (const char* at = text.data(); at != end;) {
    const char* next = *at == '~' ? wrap_end(at, end) : at;
    if (next != at) {
      out += seam;
      at = next;
    } else {
      out += *at++;
    }
  }
  return out;
}

std::string without_tail(std::string text) {
  text.erase(text.find_last_not_of(" \t~") + 1);
  return text;
}

/// CALL for CALLL if CALL is expected. The words in capitals in `expected` are keywords.
SpellingHint similar_word(std::string_view expected, std::string_view found) {
  SpellingHint hint(found);
  const auto is_capital = [](char c) { return is_ascii_letter(c) && c == ascii_upper(c); };
  const char* const end = expected.data() + expected.size();
  for (const char* at = expected.data(); at != end;) {
    const char* const word = std::find_if(at, end, is_ascii_letter);
    at = std::find_if_not(word, end, is_ascii_letter);
    const std::string_view keyword(word, at);
    if (std::all_of(word, at, is_capital)) hint.consider(keyword);
  }
  return hint;
}

}  // namespace

void Lexer::open(std::size_t begin, std::size_t end) {
  at_ = source_.data() + begin;
  end_ = source_.data() + end;
  failure_.reset();
}

Dropped Lexer::fail(DiagnosticCode code, Slice<char> place, std::string message,
                    std::string instead) {
  if (!failure_) failure_ = Failure{code, place, std::move(message), std::move(instead)};
  at_ = end_;
  return {};
}

Dropped Lexer::fail_expected(std::string_view what) {
  if (at_end()) {
    return fail(DiagnosticCode::SyntaxError, here(),
                fmt::format("expected {} before the end of the block", what));
  }
  const char* word_end = std::find_if_not(at_, end_, continues_word);
  if (word_end == at_) ++word_end;
  while (word_end != end_ && (static_cast<unsigned char>(*word_end) & 0xC0) == 0x80) ++word_end;
  const bool control_character = static_cast<unsigned char>(*at_) < 0x20;
  if (control_character) {
    return fail(DiagnosticCode::ControlCharacter, here(),
                fmt::format("expected {}, found the control character {}", what, int{*at_}));
  }
  const std::string_view found(at_, word_end);
  const SpellingHint hint = similar_word(what, found);
  return fail(DiagnosticCode::SyntaxError, place(at_, word_end),
              fmt::format("expected {}, found '{}'{}", what, excerpt(found), hint.text()),
              hint.word());
}

Dropped Lexer::refuse(const char* begin, std::string_view feature) {
  return fail(DiagnosticCode::FeatureUnsupported, since(begin), std::string(feature));
}

void Lexer::skip_wraps() {
  while (*at_ == '~') {
    const char* next = wrap_end(at_, end_);
    if (next == at_) return;
    at_ = std::find_if_not(next, end_, is_blank);
  }
}

Slice<char> Lexer::place(const char* begin, const char* end) const {
  return {static_cast<std::uint32_t>(begin - source_.data()),
          static_cast<std::uint32_t>(end - begin)};
}

bool Lexer::matches(std::string_view text) const {
  return static_cast<std::size_t>(end_ - at_) >= text.size() &&
         std::equal(text.begin(), text.end(), at_,
                    [](char a, char b) { return a == ascii_upper(b); });
}

bool Lexer::accept(char c) {
  if (at_end() || *at_ != c) return false;
  ++at_;
  return true;
}

bool Lexer::accept_word(std::string_view word) {
  skip_blanks();
  if (!matches(word) || (continues_word(word.back()) && continues_word(peek(word.size()))))
    return false;
  at_ += word.size();
  return true;
}

bool Lexer::accept_joined(std::string_view word) {
  skip_blanks();
  if (!matches(word)) return false;
  const char behind = peek(word.size());
  if (continues_word(behind) && !is_digit(behind) && !is_parameter(at_ + word.size())) return false;
  at_ += word.size();
  return true;
}

bool Lexer::accept_prefix(std::string_view prefix) {
  skip_blanks();
  if (!matches(prefix)) return false;
  at_ += prefix.size();
  return true;
}

void Lexer::expect(char c) {
  if (!accept(c)) fail_expected(fmt::format("'{}'", c));
}

void Lexer::expect_word(std::string_view word) {
  if (!accept_word(word)) fail_expected(word);
}

void Lexer::expect_joined(std::string_view word) {
  if (!accept_joined(word)) fail_expected(word);
}

void Lexer::expect_prefix(std::string_view prefix) {
  if (!accept_prefix(prefix)) fail_expected(prefix);
}

std::string_view Lexer::letters() {
  const char* end = skip_blanks();
  while (end != end_ && is_ascii_letter(*end) && !(end != at_ && is_parameter(end))) ++end;
  return std::string_view(at_, end);
}

double Lexer::number() {
  skip_blanks();
  double value = 0;
  if (!at_number()) return fail_expected("a number");
  const char* begin = at_;
  const auto skip_digits = [this] { at_ = std::find_if_not(at_, end_, is_digit); };
  skip_digits();
  if (peek() == '.' || (peek() == ',' && is_digit(peek(1)))) {
    ++at_;
    skip_digits();
  }
  std::string text(begin, at_);
  std::replace(text.begin(), text.end(), ',', '.');
  const auto error = std::from_chars(text.data(), text.data() + text.size(), value).ec;
  if (error != std::errc() || value >= kLargestNumber) {
    fail(DiagnosticCode::NumberOutOfRange, since(begin),
         fmt::format("{} is too large: use at most nine digits before the point", excerpt(text)));
  }
  return value;
}

std::uint32_t Lexer::digits(std::uint32_t largest, std::string_view what) {
  const char* begin = skip_blanks();
  std::uint64_t value = 0;
  for (; is_digit(*at_); ++at_)
    value = std::min<std::uint64_t>(value * 10 + static_cast<unsigned>(*at_ - '0'), UINT32_MAX);
  if (at_ == begin) {
    fail_expected(what);
  } else if (value > largest)
    return fail(DiagnosticCode::NumberOutOfRange, since(begin),
                fmt::format("{} {} is out of range: 0 to {}", what,
                            excerpt(std::string_view(begin, at_)), largest));
  return static_cast<std::uint32_t>(value);
}

QRef Lexer::parameter() {
  skip_blanks();
  if (!at_parameter()) return fail_expected("a Q parameter");
  const char* begin = at_++;
  QSpace space = QSpace::Q;
  if (!is_digit(*at_)) {
    const char letter = ascii_upper(*at_++);
    space = letter == 'L' ? QSpace::Ql : letter == 'R' ? QSpace::Qr : QSpace::Qs;
  }
  std::uint32_t number = 0;
  for (; is_digit(*at_); ++at_)
    number = std::min(number * 10 + static_cast<unsigned>(*at_ - '0'), 100'000U);
  if (number >= parameter_count(space)) {
    const std::string_view name(begin, at_);
    fail(DiagnosticCode::ParameterOutOfRange, since(begin),
         fmt::format("{} does not exist: the numbers go from 0 to {}", excerpt(name),
                     parameter_count(space) - 1));
    return {};
  }
  return {space, static_cast<std::uint16_t>(number)};
}

std::string_view Lexer::quoted() {
  skip_blanks();
  if (peek() != '"') return fail_expected("a text in double quotes");
  const char* begin = at_ + 1;
  const char* close = std::find_if(begin, end_, [](char c) { return c == '"' || c == '\n'; });
  if (close == end_ || *close != '"')
    return fail(DiagnosticCode::StringUnterminated, place(at_, close),
                "the text has no closing double quote");
  at_ = close + 1;
  return std::string_view(begin, close);
}

std::string_view Lexer::rest() { return rest_until(';'); }

std::string_view Lexer::rest_until(char stop) {
  const char* begin = skip_blanks();
  at_ = std::find_if(at_, end_, [stop](char c) { return c == ';' || c == stop; });
  const char* last = at_;
  while (last != begin && (is_blank(last[-1]) || last[-1] == '~' || last[-1] == '\n')) --last;
  return std::string_view(begin, last);
}

std::string_view without_wrap(std::string_view text) {
  text = trim(text);
  while (text.ends_with('~')) text = trim(text.substr(0, text.size() - 1));
  return text;
}

std::string unwrapped(std::string_view code) { return joined(code, " "); }

std::string free_text(std::string_view code) { return without_tail(unwrapped(code)); }

std::string comment_text(std::string_view comment) { return without_tail(joined(comment, "")); }

std::string excerpt(std::string_view text, std::size_t longest) {
  if (text.size() <= longest) return std::string(text);
  return std::string(first_characters(text, longest)) + "...";
}

}  // namespace fitgauge::klartext
