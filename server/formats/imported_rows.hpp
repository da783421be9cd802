#pragma once

#include "formats/qif/qif.hpp"

namespace fitgauge {

/// The rows of a file for /v1/measurements. Its name tells whether it is a QIF, a DFQ, NDJSON or a
/// table. Unusable after an error.
class ImportedRows {
 public:
  /// @param first, again two readers of one file; a DFQ, and a table or NDJSON of a given encoding,
  /// are read once, by `again`. @errors those of the format
  static Result<ImportedRows> open(std::string_view file_name, Read first, Read again,
                                   qif::QifOptions options) {
    if (qif::is_qif(file_name)) {
      auto rows = TRY(qif::QifRows::open(std::move(first), std::move(again), std::move(options)));
      return ImportedRows(std::move(rows));
    }
    if (aqdef::is_dfq(file_name))
      return ImportedRows(aqdef::MeasurementCsv(std::move(again), std::move(options)));
    if (sheet::is_ndjson(file_name)) {
      auto rows = TRY(sheet::NdjsonRows::open(first, std::move(again), options.encoding,
                                              std::move(options.limits_of)));
      return ImportedRows(std::move(rows));
    }
    auto rows = TRY(sheet::ShopRows::open(first, std::move(again), std::move(options)));
    return ImportedRows(std::move(rows));
  }

  /// The lines before the rows; empty for NDJSON.
  std::string header() const {
    const auto header_of = []([[maybe_unused]] const auto& source) -> std::string {
      if constexpr (requires { source.header(); }) return source.header();
      return {};
    };
    return std::visit(header_of, source_);
  }
  /// Appends the next rows, and their lines of the file, one for each row, if these differ.
  /// @returns false at the end. @errors those of the format
  Result<bool> append(std::string& rows, std::vector<std::uint32_t>& lines) {
    const auto append_next = [&](auto& source) {
      if constexpr (requires { source.append(rows, lines); }) {
        return source.append(rows, lines);
      } else {
        return source.append(rows);
      }
    };
    return std::visit(append_next, source_);
  }
  /// Checks the file after its last row. @errors those of the format
  Result<void> check() const {
    const auto check_it = []([[maybe_unused]] const auto& source) -> Result<void> {
      if constexpr (requires { source.check(); }) return source.check();
      return {};
    };
    return std::visit(check_it, source_);
  }

 private:
  using Source =
      std::variant<aqdef::MeasurementCsv, qif::QifRows, sheet::ShopRows, sheet::NdjsonRows>;

  explicit ImportedRows(Source source) : source_(std::move(source)) {}

  Source source_;
};

}  // namespace fitgauge
