#pragma once

#include "base/length.hpp"
#include "formats/sheet/time_zone.hpp"

namespace fitgauge::log_reader {

/// The meaning of "out of tolerance".
enum class Role : std::uint8_t {
  Hole,      ///< too small is rework, too large is reject
  Shaft,     ///< too large is rework, too small is reject
  Position,  ///< either side is reject
};

/// One characteristic of a log. Lengths are exact; of INCH to the nearest nanometre.
struct LogValue {
  std::string name;       ///< "Diameter", "Centre, main axis"; another one as the log has it
  bool is_length = true;  ///< otherwise degrees or a figure, only in `printed`
  Role role = Role::Hole;
  std::optional<Length> nominal{};
  std::optional<Length> upper{};  ///< limits: both or none
  std::optional<Length> lower{};
  Length measured{};
  std::string printed{};  ///< the measured value as the log has it
};

/// One log of one call of a cycle.
struct MeasuringLog {
  int cycle = 0;
  std::string program{};
  std::optional<sheet::WallTime> time{};  ///< of the control's clock
  bool inch = false;
  std::vector<LogValue> values{};  ///< in the order of the log
  std::string text{};              ///< only of this log, as fetched
};

struct Unread {
  std::size_t line = 0;  ///< from 1
  std::string why{};
};

/// Further ones are not reported.
inline constexpr std::size_t kMostUnread = 100;

/// Content of a file.
struct Reading {
  std::vector<MeasuringLog> logs{};
  std::vector<Unread> unread{};  ///< lines that no reader knows; the rest is still read
  bool is_unfinished = false;    ///< the last log has no end yet: the cycle may still write it
};

/// Reads consecutive logs of cycles 420 to 431 as text, in English or German, as HEIDENHAIN's
/// manuals and our simulation have them; UTF-8 or Windows-1252. Another file is one Unread.
Reading read_text_logs(std::string_view bytes);

/// Reads logs of cycles 444, 451, 452 and 453 as HTML: one section for each touched point or
/// measurement. In 444 the deviation along the normal is a value with limits; in the kinematics all
/// figures are.
Reading read_html_logs(std::string_view bytes);

/// Reads HTML or text, by its content.
Reading read_logs(std::string_view bytes);

/// Returns the number of the cycle if a line, in lower case, begins a log.
std::optional<int> cycle_of_title(std::string_view line);

/// @param date `30-06-2005`, `30.06.2005`, `30/06/2005`. @param time `6:55:04`
std::optional<sheet::WallTime> read_clock(std::string_view date, std::string_view time);

/// A length of a log: in mm, or in inch to the nearest nanometre.
std::optional<Length> read_length(std::string_view digits, bool inch);

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
  ///   between them, no measured_mm, no lines, limits without their nominal size or one of two.
  static Result<Pattern> parse(std::string_view text);

  PatternReading read(std::string_view bytes) const;

 private:
  struct Field {
    std::string name;  ///< empty: passed over
  };
  /// Literals and fields by turns.
  using Line = std::vector<std::variant<std::string, Field>>;
  using Fields = std::map<std::string, std::string, std::less<>>;

  /// Whether every result has the field.
  bool has(std::string_view name) const;
  Result<void> take_constant(std::string_view line, std::size_t number);
  Result<void> take_line(std::string_view line, std::size_t number);
  Result<void> check_field(const std::string& name, std::size_t number) const;
  static bool matches(const Line& pattern, std::string_view line, Fields& fields);

  Fields constants_;
  std::vector<Line> lines_;
};

}  // namespace fitgauge::log_reader
