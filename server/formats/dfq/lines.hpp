#pragma once

#include "formats/sheet/text_encoding.hpp"

namespace fitgauge::aqdef {

/// Code of file errors: only their text is used, never a response over HTTP.
inline constexpr ErrorCode kMalformed = ErrorCode::CsvMalformed;

/// The subject of a field of the format.
enum class Level : std::uint8_t { File, Value, Part, Characteristic, Catalogue, Group, Other };

enum class FieldType : std::uint8_t { Text, Integer, Number, Time, List };

/// A field as the tables of the format have it.
struct FieldInfo {
  int number = 0;
  FieldType type = FieldType::Text;
  int longest = 0;  ///< characters; 0: the format names no bound
  std::string_view name;
};

/// Returns the level of a number: K0001, K1xxx, K2xxx and so on.
Level level_of(int number);

/// Returns a field that is read or written here; null for others, which are stored unchanged.
const FieldInfo* field_info(int number);

/// The numbers of the fields by their names, from fields.inc.
namespace k {
#define FITGAUGE_FIELD(name, number, ...) inline constexpr int name = number;
#include "formats/dfq/fields.inc"
#undef FITGAUGE_FIELD
}  // namespace k

/// A field of a value or its part without a field in measurements.
struct CarriedField {
  int number = 0;
  std::string text;

  friend bool operator==(const CarriedField&, const CarriedField&) = default;
};

/// A comment with fields in it: `free text |K0097 {…}|K1001 4711|`. A bar in a field is doubled.
struct Comment {
  std::string text{};
  std::vector<CarriedField> fields{};
};

std::string format_comment(const Comment& comment);
/// Parses a comment; other forms are text.
Comment parse_comment(std::string_view comment);

/// Between the fields of a value, and between the values of a line.
inline constexpr char kFieldSeparator = '\x14';
inline constexpr char kValueSeparator = '\x0F';

/// A line `K2101/3 25.0`.
struct FieldLine {
  int number = 0;
  std::uint32_t index = 1;        ///< of the part, characteristic or entry; 0: all of them
  std::uint32_t value_index = 0;  ///< `K0014/3/7`: of that value; 0: of the last
  std::string_view text;          ///< without blanks around it
};

/// Whether a line is a field: a K with four digits. Any other that is not empty has values.
bool is_field_line(std::string_view line);

/// @errors kMalformed, without a place: an index that is no number.
Result<FieldLine> parse_field_line(std::string_view line);

/// The 64 bits of the origin and of the number: unique over all data folders.
std::string guid_of(std::string_view origin, std::int64_t number);

/// An error of line `line`: "line 7 has …".
Error at_line(std::uint32_t line, std::string_view what);
template <class First, class... More>
Error at_line(std::uint32_t line, fmt::format_string<First, More...> what, First&& first,
              More&&... more) {
  return at_line(line, fmt::format(what, std::forward<First>(first), std::forward<More>(more)...));
}

/// Reads the lines of an input in bounded memory. Not thread-safe.
class Lines {
 public:
  static constexpr std::size_t kRoom = std::size_t{1} << 20;  ///< of the buffer

  struct Line {
    std::string_view text;  ///< without its end; lives until a later line makes room
    std::uint32_t number = 0;
    bool is_ended = true;
  };

  explicit Lines(Read read);

  /// Continues with another input, with new line numbers. @pre next() has reached the end.
  void go_on_with(Read read);

  /// The next line that is not empty. @returns false at the end, and after a failure.
  bool next(Line& line);
  const std::optional<Error>& failure() const { return failure_; }

  /// Returns the last line to the input, so that next() reads it again.
  void unread() {
    at_ = last_at_;
    number_ = last_number_;
  }
  /// Keeps everything from the next line on.
  void mark() {
    mark_ = at_;
    marked_number_ = number_;
  }
  /// Goes back to the mark. Views of lines read since then may be invalid.
  void rewind() {
    at_ = mark_;
    number_ = marked_number_;
  }
  /// Changes whenever lines that were given before have moved.
  std::size_t moves() const { return moves_; }

 private:
  /// Reads more of the input. @returns false at the end, and after a failure.
  bool fill();
  bool fail(std::string_view what) {
    failure_ = at_line(number_, what);
    return false;
  }

  Read read_;
  std::string room_;
  std::size_t size_ = 0;
  std::size_t at_ = 0;
  std::size_t last_at_ = 0;
  std::size_t mark_ = 0;
  std::uint32_t number_ = 0;  ///< of the line before `at_`
  std::uint32_t last_number_ = 0;
  std::uint32_t marked_number_ = 0;
  std::size_t moves_ = 0;
  bool is_at_start_ = true;
  bool is_at_end_ = false;
  bool has_nul_ = false;
  std::optional<Error> failure_;
};

/// Bytes that separate() needs beyond the size of the text.
inline constexpr std::size_t kSeparateRoom = 8;

/// End of the output of separate().
struct Separated {
  std::uint32_t* starts = nullptr;
  std::uint32_t* values = nullptr;
};

/// Splits a line of values.
/// @param starts receives the begin of each field but the first: after each separator
/// @param values receives for each separator of values the number of separators up to it
/// @pre both have room for as many entries as the text has bytes, and kSeparateRoom
Separated separate(std::string_view text, std::uint32_t* starts, std::uint32_t* values);

}  // namespace fitgauge::aqdef
