#pragma once

#include "formats/sheet/record_reader.hpp"
#include "formats/sheet/time_zone.hpp"

namespace fitgauge::sheet {

/// Texts by names.
using Words = std::vector<std::pair<std::string, std::string>>;

/// Options that turn a shop's table into measurements.
struct ShopCsvOptions {
  Encoding encoding = Encoding::Detected;
  Words columns{};    ///< the table's name of a column, the field it is; empty: it is left out
  Words constants{};  ///< a field and its value, for every row
  std::optional<TimeZone> zone{};  ///< of times without an offset
  bool leaves_out_others = false;  ///< columns that are no field and that `columns` lacks
  LimitsOfClass limits_of{};       ///< null: limits of a class are not compared with the tables
};

/// Converts a table of a gauge or a spreadsheet to CSV for /v1/measurements: UTF-8, `;` between the
/// cells, field names, a line for each input line, so that errors have the file's lines.
///
/// Accepts `sep=;` before the header, `;`, a tab or `,` between the cells, empty columns and rows,
/// surrounding blanks, names in upper or lower case, and local times. An exported list of
/// measurements is accepted too: computed fields are ignored, and the limits of a class are read as
/// the class, which must give the same limits here. A table may have `date` and `time` (by
/// `columns`) instead of measured_at. Uses bounded memory; a row has at most 1 MiB. Unusable after
/// an error.
class ShopRows {
 public:
  /// @param first, again two readers of one table: `first` only detects the encoding.
  /// @errors TextEncoding, CsvMalformed
  static Result<ShopRows> open(const Read& first, Read again, ShopCsvOptions options);

  /// Returns the header, with an empty line for each line of the table before its header.
  const std::string& header() const { return header_; }
  /// Appends the next row. @returns false at the end.
  /// @errors TextEncoding; CsvMalformed and TimeMalformed with the line in `where`.
  Result<bool> append(std::string& rows);

 private:
  ShopRows(Utf8Input input, ShopCsvOptions options)
      : options_(std::move(options)), records_(std::move(input)) {}

  /// @errors CsvMalformed, TextEncoding
  Result<void> read_header();
  /// The field of a column: empty if it is left out or unknown.
  std::string field_of(std::string_view column) const;
  std::string header_of(const Record& record);
  /// @errors those of read_exported.
  Result<void> read_export(const Record& record);
  Result<void> convert_row(const Record& record, std::string& rows);
  Result<std::string> measured_at(const Record& record, std::string_view text) const;
  const std::string* cell(const Record& record, std::string_view field) const;

  ShopCsvOptions options_;
  RecordReader records_;
  Record record_;
  std::string header_;
  std::vector<std::string> fields_;   ///< of the columns; empty: left out
  bool has_clock_ = false;            ///< date and time are in separate columns
  std::vector<std::string> members_;  ///< of the columns of an export; else empty
  ExportedRow exported_;              ///< the row of an export that is converted
};

}  // namespace fitgauge::sheet
