#pragma once

#include "base/folder.hpp"
#include "base/length.hpp"
#include "formats/sheet/time_zone.hpp"

struct lxw_format;
struct lxw_workbook;
struct lxw_worksheet;

namespace fitgauge::workbook {

/// An XLSX of one sheet, written cell by cell, each row to disk at its end, in constant memory.
/// Lengths are numbers with their unit, times are times, and a text is always a text. Not
/// thread-safe; unusable after an error.
class Workbook {
 public:
  static constexpr std::size_t kMostRows = 1'048'575;  ///< rows of a sheet below its header

  /// Begins the sheet with its header, which stays visible.
  /// @errors StorageUnavailable: the folder of temporary files (TMPDIR, else /tmp) is full.
  /// @param zone of the times; none: UTC
  static Result<Workbook> make(std::string_view sheet, std::span<const std::string> header,
                               std::optional<sheet::TimeZone> zone);

  /// Goes to the next cell of the row, which is blank if nothing is written to it.
  void begin_cell() { ++cells_; }
  void word(std::string_view word) { text(word); }
  void name(std::string_view name) { text(name); }
  void text(std::string_view text);
  void mm(Length length);
  void um(Length length);
  /// @param value in units of 10^-scale
  void decimal(std::int64_t value, int scale);
  void billionths(std::int64_t value) { decimal(value, 9); }
  /// Writes a wall-clock time, because a cell has no offset. A time before 1900-03-01, which a
  /// sheet cannot count, becomes a text.
  void time(Timestamp time);
  void truth() { text("true"); }
  void null() {}
  void end_row() {
    ++row_;
    cells_ = 0;
  }

  /// The whole file. @errors StorageUnavailable: it could not be written.
  Result<std::string> finish();

 private:
  Workbook();
  void took(int error) {
    if (error != 0) failure_ = error;
  }
  void write(std::string_view text, lxw_format* as);
  void number(double value, lxw_format* as);

  Descriptor file_;  ///< in memory
  std::unique_ptr<lxw_workbook, void (*)(lxw_workbook*)> book_;
  lxw_worksheet* sheet_ = nullptr;
  lxw_format* mm_ = nullptr;
  lxw_format* um_ = nullptr;
  lxw_format* time_ = nullptr;
  std::uint32_t row_ = 0;
  std::uint16_t cells_ = 0;  ///< of the row that are begun
  std::optional<sheet::TimeZone> zone_;
  int failure_ = 0;  ///< an lxw_error
};

}  // namespace fitgauge::workbook
