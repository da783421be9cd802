#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "formats/sheet/text_encoding.hpp"
#include "formats/sheet/time_zone.hpp"

namespace fitgauge::sheet {

/// Texts by names.
using Words = std::vector<std::pair<std::string, std::string>>;

/// How a shop's table becomes measurements.
struct ShopCsvOptions {
  Encoding encoding = Encoding::Detected;
  Words columns{};    ///< the table's name of a column, the field it is; empty: it is left out
  Words constants{};  ///< a field and its value, for every row
  std::optional<TimeZone> zone{};  ///< of times without an offset
  bool leaves_out_others = false;  ///< columns that are no field and that `columns` lacks
};

/// Turns a table as gauges and spreadsheets write it into CSV as /v1/measurements takes it: UTF-8,
/// `;` between the cells, the fields by their names, one line for one line, so that errors name the
/// lines of the shop's file.
///
/// Read are `sep=;` before the header, `;`, a tab or `,` between the cells, empty columns and rows
/// without text, blanks around a text, names in either case, and times of a clock on the wall.
/// The CSV of a list of measurements is taken back: what was computed is left out, and limits of a
/// class are those of the class.
/// A table may have `date` and `time` (by `columns`) instead of measured_at. It is read in a
/// bounded piece of memory; a row has at most 1 MiB. Of no more use after an error.
class ShopRows {
 public:
  /// @param first and again read the same table from its begin, one after the other; `first` only
  ///   where the encoding is to be detected.
  /// @errors TextEncoding, CsvMalformed
  static Result<ShopRows> open(const Read& first, Read again, ShopCsvOptions options);
  ShopRows(ShopRows&&) noexcept;
  ShopRows& operator=(ShopRows&&) noexcept;
  ~ShopRows();

  /// As many lines as the table has up to the end of its own.
  const std::string& header() const { return header_; }
  /// Appends the next row. @returns false at the end.
  /// @errors TextEncoding; CsvMalformed and TimeMalformed, whose `where` is the line.
  Result<bool> append(std::string& rows);

 private:
  class Converter;
  ShopRows(std::unique_ptr<Converter> converter, std::string header);

  std::unique_ptr<Converter> converter_;
  std::string header_;
};

}  // namespace fitgauge::sheet
