#pragma once

#include "base/result.hpp"
#include "formats/sheet/text_encoding.hpp"
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
};

/// Converts a table of a gauge or a spreadsheet to CSV for /v1/measurements: UTF-8, `;` between the
/// cells, field names, one output line for each input line, so that errors have the lines of the
/// shop's file.
///
/// Accepts `sep=;` before the header, `;`, a tab or `,` between the cells, empty columns and rows,
/// surrounding blanks, names in upper or lower case, and local times. An exported list of
/// measurements is accepted too: computed fields are ignored, and the limits of a class are read as
/// the class. A table may have `date` and `time` (by `columns`) instead of measured_at. Uses
/// bounded memory; a row has at most 1 MiB. Unusable after an error.
class ShopRows {
 public:
  /// @param first, again two readers of one table: `first` is read first, only
  /// to detect the encoding.
  /// @errors TextEncoding, CsvMalformed
  static Result<ShopRows> open(const Read& first, Read again, ShopCsvOptions options);
  ShopRows(ShopRows&&) noexcept;
  ShopRows& operator=(ShopRows&&) noexcept;
  ~ShopRows();

  /// Returns the header, with an empty line for each line of the table before its header.
  const std::string& header() const { return header_; }
  /// Appends the next row. @returns false at the end.
  /// @errors TextEncoding; CsvMalformed and TimeMalformed with the line in `where`.
  Result<bool> append(std::string& rows);

 private:
  class Converter;
  ShopRows(std::unique_ptr<Converter> converter, std::string header);

  std::unique_ptr<Converter> converter_;
  std::string header_;
};

}  // namespace fitgauge::sheet
