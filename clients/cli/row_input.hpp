#pragma once

#include "cli/measure_command.hpp"
#include "formats/sheet/shop_csv.hpp"

namespace fitgauge::cli {

/// Converts a DFQ, a QIF, NDJSON or a table of the shop for the service, in bounded memory.
class RowInput {
 public:
  /// Returns whether the input is a table, by its name and options.
  static bool is_one(const MeasureOptions& options);
  /// Returns whether line numbers refer to the file.
  static bool keeps_lines(const MeasureOptions& options);

  /// @param context and options outlive it. @errors Usage, LocalFile
  static Outcome<RowInput> open(const Context& context, const MeasureOptions& options);

  /// The next bytes of the rows; 0 at the end. @errors LocalFile: the file is wrong, with its line.
  Outcome<std::size_t> read(std::span<char> into);

  /// Returns the line of the file for a line of the CSV: reads the file again up to there.
  static std::uint64_t line_of(const Context& context, const MeasureOptions& options,
                               std::uint64_t csv_line);

 private:
  struct State;
  static Outcome<RowInput> open_dfq(const Context& context, const MeasureOptions& options,
                                    sheet::ShopCsvOptions table);
  static Outcome<RowInput> open_qif(const Context& context, const MeasureOptions& options,
                                    sheet::ShopCsvOptions table);
  static Outcome<RowInput> open_ndjson(const MeasureOptions& options);
  static Outcome<RowInput> open_table(const MeasureOptions& options, sheet::ShopCsvOptions table);
  explicit RowInput(std::shared_ptr<State> state) : state_(std::move(state)) {}
  /// The next rows. @returns false at the end.
  Outcome<bool> fill();

  std::shared_ptr<State> state_;
};

/// Whether the options are for a table of the shop.
bool is_converted(const MeasureOptions& options);

/// Settings of a table or a DFQ from the options. @errors Usage
Outcome<sheet::ShopCsvOptions> table_options(const MeasureOptions& options);

}  // namespace fitgauge::cli
