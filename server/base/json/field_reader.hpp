#pragma once

#include "base/json/json_value.hpp"
#include "base/length.hpp"

namespace fitgauge::api {

/// A request member that only some kinds of the request use; others refuse it as without effect.
struct Applicable {
  std::string_view member;
  std::string_view kinds;     ///< kinds that use it: `xbar_r xbar_s`
  std::string_view values{};  ///< which of its values it is asked for; empty: all
};

/// `a, b or c` of `a b c`.
std::string listed(std::string_view words);

/// Returns why a member is refused; none if the kind uses it.
/// @param what name of the kind: `kind`, `method`, `rule`
std::optional<std::string> not_applicable(const Applicable& row, std::string_view what,
                                          std::string_view kind);

/// Calls `refuse(member, message)` for each row whose member is given and is refused.
template <class Given, class Refuse>
void refuse_not_applicable(std::span<const Applicable> table, std::string_view what,
                           std::string_view kind, const Given& given, const Refuse& refuse) {
  for (const Applicable& row : table) {
    if (!given(row)) continue;
    if (const auto message = not_applicable(row, what, kind)) refuse(row.member, *message);
  }
}

/// Collects all errors of a body, to report them together.
class FieldErrors {
 public:
  /// Number of errors that are listed; further errors are counted.
  static constexpr std::size_t kMostListed = 100;

  /// @param line of a format that has lines; it becomes the place of a detail of the entry.
  void add(ErrorCode code, std::string pointer, std::string message,
           std::optional<std::size_t> line = {});
  bool empty() const { return count_ == 0; }
  /// Whether an entry of that pointer is listed.
  bool has(std::string_view pointer) const;

  /// Errors added after a mark can be removed again.
  using Mark = std::size_t;
  Mark mark() const { return count_; }
  void rollback(Mark mark);

  /// RequestInvalid with every entry in `details`, or none when nothing was wrong.
  std::optional<Error> take();

 private:
  std::size_t count_ = 0;
  std::vector<Error> entries_;
};

/// Reads the members of one JSON object, each at most once. Missing or unreadable members go to the
/// FieldErrors with their pointer. An optional member may be absent, not null. The value and the
/// errors must outlive it.
class FieldReader {
 public:
  FieldReader(const JsonValue& object, std::string pointer, FieldErrors& errors);

  // Required members.
  std::optional<Length> mm(std::string_view name);
  std::optional<Length> um(std::string_view name);
  std::optional<double> number(std::string_view name);
  std::optional<bool> boolean(std::string_view name);
  std::optional<std::string> text(std::string_view name);
  std::optional<std::int64_t> integer(std::string_view name, std::int64_t least, std::int64_t most);
  const JsonValue* array(std::string_view name);
  const JsonValue* any(std::string_view name);
  const JsonValue* object(std::string_view name);

  // Members that may be absent.
  std::int64_t integer_or(std::string_view name, std::int64_t fallback, std::int64_t least,
                          std::int64_t most);
  std::optional<std::string> optional_text(std::string_view name);
  const JsonValue* optional(std::string_view name);

  /// Reports every member that is given and that its kind does not use.
  void refuse_not_applicable(std::span<const Applicable> table, std::string_view what,
                             std::string_view kind);
  /// Reports every member that was not asked for.
  void refuse_unknown();

  bool has(std::string_view name) const { return object_.find(name) != nullptr; }
  std::string at(std::string_view name) const { return pointer_to(pointer_, name); }
  void report(ErrorCode code, std::string_view name, std::string message);
  template <class... Arguments>
  void report(ErrorCode code, std::string_view name, fmt::format_string<Arguments...> format,
              Arguments&&... arguments) requires(sizeof...(Arguments) > 0) {
    report(code, name, fmt::format(format, std::forward<Arguments>(arguments)...));
  }
  FieldErrors& errors() { return errors_; }

 private:
  const JsonValue* take(std::string_view name, bool required);
  const JsonValue* take(std::string_view name, bool required,
                        std::initializer_list<JsonValue::Kind> kinds, std::string_view wanted);
  std::optional<Length> length(std::string_view name, bool micrometres);

  const JsonValue& object_;
  std::string pointer_;
  FieldErrors& errors_;
  std::vector<std::string_view> known_;
};

}  // namespace fitgauge::api
