#pragma once

#include "base/clock.hpp"
#include "base/length.hpp"

namespace fitgauge::workbook {

/// An XLSX of one sheet, written cell by cell, each row to disk at its end, in constant memory.
/// Lengths are numbers with their unit, times are times, and a text is always a text. Not
/// thread-safe; unusable after an error.
class Workbook {
 public:
  static constexpr std::size_t kMostRows = 1'048'575;  ///< rows of a sheet below its header

  /// Begins the sheet with its header, which stays visible.
  /// @errors StorageUnavailable: the folder of temporary files (TMPDIR, else /tmp) is full.
  static Result<Workbook> make(std::string_view sheet, std::span<const std::string> header);
  Workbook(Workbook&&) noexcept;
  Workbook& operator=(Workbook&&) noexcept;
  ~Workbook();

  // The next cell of the row.
  void text(std::string_view text);
  void mm(Length length);
  void um(Length length);
  /// @param value in units of 10^-scale
  void decimal(std::int64_t value, int scale);
  /// Writes a wall-clock time, because a cell has no offset. A time before 1900-03-01, which a
  /// sheet cannot count, becomes a text.
  void time(Timestamp time);
  void blank();
  void end_row();

  /// The whole file. @errors StorageUnavailable: it could not be written.
  Result<std::string> finish();

 private:
  struct State;
  explicit Workbook(std::unique_ptr<State> state);

  std::unique_ptr<State> state_;
};

}  // namespace fitgauge::workbook
