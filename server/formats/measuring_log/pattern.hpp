#pragma once

#include "base/result.hpp"
#include "formats/measuring_log/measuring_log.hpp"

namespace fitgauge::log_reader {

/// One result of an FN 16 file: the fields of its pattern, and the lines it was read from.
struct PatternResult {
  std::map<std::string, std::string, std::less<>> fields{};
  std::string text{};
};

struct PatternReading {
  std::vector<PatternResult> results{};
  std::vector<Unread> unread{};  ///< results that begin and lack a line
  bool is_unfinished = false;    ///< the last result lacks its last lines
};

/// The pattern of an FN 16 mask, given once for all its files:
///
///     characteristic = bore-A
///     tolerance_class = H7
///     nominal_mm = 25
///     ---
///     PART {part_id}
///     DIAMETER {measured_mm} MM
///
/// Above `---` are fields that every result has, below it the lines of a result in their order.
/// `{field}` reads a text, `{}` skips a text. Several blanks count as one blank. Other lines
/// between the lines of the pattern are skipped. Immutable.
class Pattern {
 public:
  /// @errors ConfigInvalid with the line: an unknown or doubled field, two fields with nothing
  ///   between them, no measured_mm, no lines.
  static Result<Pattern> parse(std::string_view text);

  PatternReading read(std::string_view bytes) const;

 private:
  struct Field {
    std::string name;  ///< empty: passed over
  };
  /// Literals and fields by turns.
  using Line = std::vector<std::variant<std::string, Field>>;
  using Fields = std::map<std::string, std::string, std::less<>>;

  Result<void> take_constant(std::string_view line, std::size_t number);
  Result<void> take_line(std::string_view line, std::size_t number);
  Result<void> check_field(const std::string& name, std::size_t number) const;
  static bool matches(const Line& pattern, std::string_view line, Fields& fields);

  Fields constants_;
  std::vector<Line> lines_;
};

}  // namespace fitgauge::log_reader
