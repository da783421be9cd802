#pragma once

#include "formats/step/part21.hpp"

namespace fitgauge::step {

/// An error at a place of the text, with its line.
inline Error error_at(const FileText& text, std::size_t at, std::string_view message) {
  std::ptrdiff_t line = 1;
  text.each_stretch(at, [&line](std::string_view part) { line += std::ranges::count(part, '\n'); });
  return {ErrorCode::DrawingMalformed, fmt::format("line {}: {}", line, message),
          fmt::format("line {}", line)};
}

/// Reads the tokens of a text, and checks each.
class Lexer {
 public:
  explicit Lexer(const FileText& text) : file_(text), text_(text.text) {}

  std::size_t at() const { return at_; }
  void go_to(std::size_t at) { at_ = at; }
  std::string_view from(std::size_t begin) const { return text_.substr(begin, at_ - begin); }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool is_at_end() const { return at_ >= text_.size(); }

  /// Passes white space and comments.
  void skip();
  /// Skips the character and white space after it.
  bool take(char c) {
    if (peek() != c || is_at_end()) return false;
    ++at_;
    skip();
    return true;
  }
  /// `ADVANCED_FACE`, `!OWN`, `END-ISO-10303-21`; empty if there is none.
  std::string_view keyword();
  /// Reads any parameter with its content. @param deep number of lists that may still be opened
  bool parameter(Parameter& to, int deep);
  /// `(…)`; @param each gets every parameter
  template <class Each>
  bool list(int deep, const Each& each);
  bool list(int deep) {
    return list(deep, [](const Parameter&) { return true; });
  }

  bool fail(std::string_view message);
  template <class First, class... More>
  bool fail(fmt::format_string<First, More...> message, First&& first, More&&... more) {
    return fail(std::string_view(
        fmt::format(message, std::forward<First>(first), std::forward<More>(more)...)));
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  bool text();
  bool number();
  bool between(char delimiter, bool (*is_allowed)(char), std::string_view what);
  bool reference(Parameter& to);
  std::size_t digits();

  FileText file_;
  std::string_view text_;
  std::size_t at_ = 0;
  std::optional<Error> error_;
};

template <class Each>
bool Lexer::list(int deep, const Each& each) {
  if (deep == 0) return fail("lists are nested more than 32 levels deep");
  if (!take('(')) return fail("( expected");
  if (take(')')) return true;
  for (;;) {
    Parameter item;
    if (!parameter(item, deep - 1) || !each(item)) return false;
    if (take(')')) return true;
    if (!take(',')) return fail("a comma or ) expected");
  }
}

}  // namespace fitgauge::step
