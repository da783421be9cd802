#include "formats/step/part21.hpp"

namespace fitgauge::step {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_upper(char c) { return (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_of_word(char c) { return is_upper(c) || is_digit(c); }
bool is_hexadecimal(char c) { return is_digit(c) || (c >= 'A' && c <= 'F'); }
bool is_white(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

bool Lexer::fail(std::string_view message) {
  if (error_) return false;
  const bool is_cut = is_at_end();
  error_ = error_at(file_, std::min(at_, text_.size()),
                    is_cut ? fmt::format("the file ends here, {}: export or send it again", message)
                           : fmt::format("{}: export the file again", message));
  return false;
}

void Lexer::skip() {
  for (;;) {
    while (at_ < text_.size() && is_white(text_[at_])) ++at_;
    if (text_.compare(at_, 2, "/*") != 0) return;
    const std::size_t end = text_.find("*/", at_ + 2);
    if (end == std::string_view::npos) {
      fail("a comment has no */");
      at_ = text_.size();
      return;
    }
    at_ = end + 2;
  }
}

std::string_view Lexer::keyword() {
  const std::size_t begin = at_;
  if (peek() == '!') ++at_;
  if (!is_upper(peek())) return {};
  while (is_of_word(peek()) || peek() == '-') ++at_;
  const std::string_view word = from(begin);
  skip();
  return word;
}

std::size_t Lexer::digits() {
  const std::size_t begin = at_;
  while (is_digit(peek())) ++at_;
  return at_ - begin;
}

bool Lexer::number() {
  if (peek() == '+' || peek() == '-') ++at_;
  if (digits() == 0) return fail("a number has no digits");
  if (peek() != '.') return true;
  ++at_;
  digits();
  if (peek() != 'E') return true;
  ++at_;
  if (peek() == '+' || peek() == '-') ++at_;
  return digits() > 0 || fail("an exponent has no digits");
}

bool Lexer::text() {
  const std::size_t begin = at_++;
  for (;;) {
    at_ = text_.find('\'', at_);
    if (at_ == std::string_view::npos) {
      at_ = text_.size();
      return fail("a text has no closing '");
    }
    if (at_ - begin > Part21::kLongestText) return fail("a text has more than 1048576 bytes");
    ++at_;
    if (peek() != '\'') return true;
    ++at_;
  }
}

bool Lexer::between(char delimiter, bool (*is_allowed)(char), std::string_view what) {
  do ++at_;
  while (is_allowed(peek()));
  if (peek() != delimiter) return fail("{} has no closing {}", what, delimiter);
  ++at_;
  return true;
}

bool Lexer::reference(Parameter& to) {
  const std::size_t begin = ++at_;
  if (digits() == 0) {
    // Edition 3: a constant or a value, which no drawing's sizes use.
    to.kind = Parameter::Kind::Binary;
    return !keyword().empty() || fail("a name has # or @ and no number");
  }
  const std::string_view number = from(begin);
  const auto read = std::from_chars(number.data(), number.data() + number.size(), to.id);
  if (read.ec != std::errc()) return fail("an instance number is above 4294967295");
  return true;
}

bool Lexer::parameter(Parameter& to, int deep) {
  const std::size_t begin = at_;
  const char first = peek();
  bool is_read = true;
  if (first == '#' || first == '@') {
    to.kind = first == '#' ? Kind::Reference : Kind::Binary;
    is_read = reference(to);
  } else if (first == '\'') {
    to.kind = Kind::Text;
    is_read = text();
  } else if (first == '(') {
    to.kind = Kind::List;
    is_read = list(deep);
  } else if (first == '.') {
    to.kind = Kind::Word;
    is_read = between('.', is_of_word, "a word");
  } else if (first == '"') {
    to.kind = Kind::Binary;
    is_read = between('"', is_hexadecimal, "a binary");
  } else if (first == '<') {
    to.kind = Kind::Binary;
    is_read = between(
        '>', [](char c) { return c > ' ' && c != '>'; }, "a resource");
  } else if (is_upper(first) || first == '!') {
    to.kind = Kind::Typed;
    keyword();
    std::size_t count = 0;
    is_read = list(deep, [&count](const Parameter&) { return ++count > 0; }) &&
              (count == 1 || fail("a typed parameter must have one value"));
  } else if (first == '$' || first == '*') {
    ++at_;
  } else if (is_digit(first) || first == '+' || first == '-') {
    to.kind = Kind::Number;
    is_read = number();
  } else {
    return fail("a parameter expected");
  }
  to.text = from(begin);
  skip();
  return is_read && !error_;
}

}  // namespace fitgauge::step
