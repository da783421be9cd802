#pragma once

#include "base/csv.hpp"
#include "formats/sheet/lengths.hpp"
#include "formats/sheet/text_encoding.hpp"
#include "record/measurement_row_reader.hpp"

namespace fitgauge::sheet {

/// Names of the fields that a row of /v1/measurements may have, in the order of its description.
inline constexpr auto kMeasurementFields = [] {
  std::array<std::string_view, api::RowField::Count> names{};
  std::ranges::transform(api::kRowFields, names.begin(), &api::RowField::name);
  return names;
}();

}  // namespace fitgauge::sheet

namespace fitgauge::aqdef {

// Columns of the fields of a measurement.

inline constexpr auto& kNames = sheet::kMeasurementFields;

constexpr std::size_t place_of(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kNames, name) - kNames.begin());
}

inline constexpr std::size_t kMeasured = place_of("measured_mm");
inline constexpr std::size_t kNominal = place_of("nominal_mm");
inline constexpr std::size_t kClass = place_of("tolerance_class");
inline constexpr std::size_t kFeature = place_of("feature");
inline constexpr std::size_t kQuantity = place_of("quantity");
inline constexpr std::size_t kUpper = place_of("upper_um");
inline constexpr std::size_t kLower = place_of("lower_um");
inline constexpr std::size_t kPartId = place_of("part_id");
inline constexpr std::size_t kName = place_of("characteristic");
inline constexpr std::size_t kOrder = place_of("order");
inline constexpr std::size_t kOperation = place_of("operation");
inline constexpr std::size_t kMachine = place_of("machine");
inline constexpr std::size_t kOperator = place_of("operator");
inline constexpr std::size_t kGauge = place_of("gauge");
inline constexpr std::size_t kUnit = place_of("unit");
inline constexpr std::size_t kComment = place_of("comment");
inline constexpr std::size_t kSubgroup = place_of("subgroup");
inline constexpr std::size_t kMeasuredAt = place_of("measured_at");
static_assert(kMeasuredAt < kNames.size() && kPartId < kSubgroup);

}  // namespace fitgauge::aqdef

namespace fitgauge::sheet {

/// Appends a line of CSV of all kMeasurementFields; those that people write cannot be formulas.
template <class Fields>
void append_row(std::string& rows, const Fields& fields) {
  for (std::size_t place = 0; place < fields.size(); ++place) {
    if (place > 0) rows += ';';
    const bool is_text = place >= aqdef::kPartId && place <= aqdef::kSubgroup;
    (is_text ? append_csv_text : append_csv_cell)(rows, fields[place], CsvSeparator::Semicolon);
  }
  rows += '\n';
}

/// An error in a line of a table; `where` is the line.
Error at_table_line(ErrorCode code, std::size_t line, std::string_view what);

/// Returns the text without blanks, tabs and no-break spaces around it.
std::string_view bare(std::string_view text);

/// One line of a table, which may span several of the text.
struct Record {
  std::size_t line = 0;
  std::size_t lines = 0;  ///< of the text
  std::vector<std::string> cells{};

  bool is_empty() const {
    return std::ranges::all_of(cells, [](const std::string& cell) { return bare(cell).empty(); });
  }
};

/// Reads the records of a text in order. Holds at most one and a piece. Unusable after an error.
class RecordReader {
 public:
  static constexpr std::size_t kMostCells = 1000;
  static constexpr std::size_t kLongestRecord = std::size_t{1} << 20;
  static constexpr char kNone = '\n';  ///< separator if the text is read by lines

  explicit RecordReader(Utf8Input input) : input_(std::move(input)) {}

  void set_separator(char separator) { separator_ = separator; }
  std::size_t line() const { return line_; }

  /// Returns the next line without its end, until it is taken; also empty at the end.
  /// @errors CsvMalformed, TextEncoding
  Result<std::string_view> peek_line();
  /// @param line what peek_line() has given
  void pass_line(std::string_view line) {
    rest_ = std::string_view(room_).substr(at_ + line.size());
    if (take_line_end()) ++line_;
    at_ = room_.size() - rest_.size();
  }
  /// After peek_line().
  bool is_at_end() const { return is_at_end_ && at_ == room_.size(); }

  /// @returns false at the end. @errors CsvMalformed, TextEncoding
  Result<bool> next(Record& record);

 private:
  Result<void> fill();
  Result<void> read_record(Record& record);
  Result<void> read_cell(std::string& cell, Record& record);
  bool take_line_end() {
    if (rest_.empty()) return false;
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    return true;
  }

  Utf8Input input_;
  std::string room_{};  ///< read, and consumed up to `at_`
  std::size_t at_ = 0;
  bool is_at_end_ = false;   ///< the input ends with `room_`
  std::string_view rest_{};  ///< of `room_`, while a record is read
  std::size_t line_ = 1;
  char separator_ = ';';
};

// Imports an export of fitgauge: ignores computed fields; limits of a class become the class.

/// Members that each record of a list of /v1/measurements has, and no other row has all of.
inline constexpr std::array<std::string_view, 4> kOfExport = {"basis", "id", "received_at",
                                                              "source"};
inline constexpr std::string_view kDesignation = "designation";

/// Form of the limits of an exported record.
struct ExportedRow {
  bool has_drawn_limits = true;
  bool has_feature = true;    ///< which the limits do not imply
  std::string designation{};  ///< of another standard, in place of the nominal size and the class
};

/// Reads the form of the limits of an exported record, and compares the limits of a class.
/// @param text_of a member; empty: absent. @param limits_of may be null: then nothing is compared.
/// @errors CsvMalformed, without a place: it is simulated, it is a correction, or the class gives
/// other limits here.
Result<ExportedRow> read_exported(
    const std::function<std::string_view(std::string_view member)>& text_of,
    const LimitsOfClass& limits_of);

/// Returns the field of a member; empty if it was computed or repeats another one.
std::string_view field_of_export(std::string_view member, const ExportedRow& row);

/// Whether a file name ends with `.ndjson` or `.jsonl`.
bool is_ndjson(std::string_view file_name);

/// Reads an NDJSON file of any size for /v1/measurements, also exported records, line by line, so
/// that errors have the lines of the file. Unusable after an error.
class NdjsonRows {
 public:
  /// @param first and again as for Utf8Input. @param limits_of as for read_exported
  /// @errors TextEncoding
  static Result<NdjsonRows> open(const Read& first, Read again, Encoding encoding,
                                 LimitsOfClass limits_of) {
    auto input = TRY(Utf8Input::open(first, std::move(again), encoding));
    return NdjsonRows(std::move(input), std::move(limits_of));
  }

  /// Appends the next line. @returns false at the end.
  /// @errors TextEncoding; CsvMalformed with the line in `where`.
  Result<bool> append(std::string& rows);

 private:
  NdjsonRows(Utf8Input input, LimitsOfClass limits_of)
      : lines_(std::move(input)), limits_of_(std::move(limits_of)) {
    lines_.set_separator(RecordReader::kNone);
  }
  /// Appends a record of a list with its original fields, any other line unchanged.
  /// @errors those of read_exported.
  Result<void> append_as_given(std::string& out, std::string_view line) const;

  RecordReader lines_;
  LimitsOfClass limits_of_;
};

}  // namespace fitgauge::sheet
