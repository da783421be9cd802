#pragma once

#include "base/mapped_file.hpp"

// A STEP file as text: ISO 10303-21, editions 2 and 3, read strictly and in one pass. It needs
// eight bytes of memory for an instance, and reads an instance again from the text at each request.

namespace fitgauge::step {

/// A parameter of a record, as views of the text.
struct Parameter {
  enum class Kind : std::uint8_t { Absent, Number, Text, Word, Reference, List, Typed, Binary };
  Kind kind = Kind::Absent;  ///< of `$` and `*`
  std::string_view text{};   ///< as written: `'a''b'`, `.T.`, `(#1,#2)`, `LENGTH_MEASURE(35.)`
  std::uint32_t id = 0;      ///< of a reference

  bool is(Kind other) const { return kind == other; }
};
using Kind = Parameter::Kind;

/// `NAME(…)`: a record of an instance or a typed parameter.
struct Record {
  std::string_view name;
  std::string_view list;  ///< its parameters with their parentheses
};

/// The text of a string parameter as UTF-8, without its controls; empty for another parameter.
std::string text_of(const Parameter& parameter);
/// The nearest double of a number, or infinity; 0 of another parameter.
double number_of(const Parameter& parameter);

/// Reads text that Part21::read has checked. The text must outlive it. After the first failure
/// every result is empty and error() has the failure. Used by one thread.
class Part21 {
 public:
  static constexpr std::size_t kMostInstances = std::size_t{8} << 20;
  static constexpr std::size_t kLongestText = std::size_t{1} << 20;  ///< of a string, in bytes
  static constexpr int kDeepest = 32;                                ///< lists within lists
  static constexpr std::size_t kMostItems = std::size_t{1} << 16;    ///< of a list that is read

  /// @param names of the records for of_name()
  /// @errors DrawingMalformed with the line, the fault and its remedy.
  static Result<Part21> read(const FileText& text, std::span<const std::string_view> names,
                             std::size_t most_instances = kMostInstances);

  /// The instances with a record of that name, in the order of the file.
  std::span<const std::uint32_t> of_name(std::size_t name) const { return by_name_[name]; }

  /// One record, or the records of a complex instance. A missing instance is a failure at `from`.
  std::vector<Record> records(std::uint32_t id, std::uint32_t from) const;
  /// Returns the parameters of a list, or the parameter in a typed parameter.
  std::vector<Parameter> parameters(std::string_view list) const;

  /// Fails at the instance; the first failure stays.
  void fail(std::uint32_t id, std::string message) const;
  const std::optional<Error>& error() const { return error_; }

 private:
  struct Instance {
    std::uint32_t id;
    std::uint32_t at;  ///< of the text after the `=`
  };
  friend class Part21Scanner;

  Part21() = default;
  const Instance* find(std::uint32_t id) const;
  bool walk(std::string_view text) const;

  FileText text_;
  std::deque<Instance> instances_;  // by id; grows without a second copy
  std::vector<std::vector<std::uint32_t>> by_name_;
  mutable std::size_t walked_ = 0;   ///< bytes read again
  mutable std::size_t records_ = 0;  ///< of them
  mutable std::optional<Error> error_;
};

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

  /// The `;` after a statement.
  bool end() { return take(';') || fail("; expected"); }
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
