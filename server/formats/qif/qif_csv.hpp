#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "formats/dfq/description.hpp"
#include "formats/dfq/lines.hpp"
#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::qif {

struct QifOptions {
  sheet::Words constants{};               ///< a field and its value, where the document says none
  std::optional<sheet::TimeZone> zone{};  ///< of times without an offset
  std::optional<aqdef::LengthUnit> length_unit{};  ///< where FileUnits says none
  bool leaves_out_others = false;  ///< characteristics that are no size, or have no value
  aqdef::LimitsOfClass limits_of{};
  std::size_t most_rows = 100'000;
};

/// The measurements of a document as CSV that /v1/measurements takes.
struct QifText {
  std::string csv{};
  std::vector<std::uint32_t> lines{};  ///< of the document, for each line below the header
};

/// Whether the name of a file says so: `.qif`.
bool is_qif(std::string_view file_name);

/// Reads the sizes that a QIF 3 document has measured: diameters, widths, lengths, thicknesses and
/// such, with the tolerance of their characteristic, which must not contradict its class. An
/// attribute by the name of a field of /v1/measurements is that field. The document is read twice,
/// element by element, in a bounded piece of memory. Of no more use after an error.
class QifRows {
 public:
  /// @param first and again read the same document from its begin, one after the other
  /// @errors CsvMalformed with the line
  static Result<QifRows> open(Read first, Read again, QifOptions options);
  QifRows(QifRows&&) noexcept;
  QifRows& operator=(QifRows&&) noexcept;
  ~QifRows();

  std::string header() const;
  /// Appends the row of the next measurement, and the line of the document for each of its lines.
  /// @returns false at the end. @errors CsvMalformed with the line
  Result<bool> append(std::string& rows, std::vector<std::uint32_t>& lines);
  /// When all is read. @errors CsvMalformed: there was none.
  Result<void> check() const;

 private:
  class Converter;
  explicit QifRows(std::unique_ptr<Converter> converter);

  std::unique_ptr<Converter> converter_;
};

/// All rows of a document in memory. @errors as QifRows
Result<QifText> read_qif(std::string_view text, const QifOptions& options);

}  // namespace fitgauge::qif
