#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/allowance.hpp"
#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::app {

/// A table of the control about its own machine: tool.t, tchprobe.tp or preset.pr.
struct MachineTable {
  std::string path;
  tabfile::TabTable table;

  /// The table of that name in `TNC:\table\`, where TNC 640 and TNC7 keep it, else in `TNC:\`.
  /// @errors TableFileMalformed.
  static Result<std::optional<MachineTable>> find(const interpreter::ControlDisk& disk,
                                                  std::string_view name, Allowance& allowance);
  /// Changes whenever `find` would give something else. Reads no file.
  static std::string revision(const interpreter::ControlDisk& disk, std::string_view name);

  /// The number in the first column of a row; none for an indexed tool (5.1).
  /// @errors TableFileMalformed.
  Result<std::optional<std::int64_t>> number_of(std::size_t row) const;

  Error malformed(std::string_view what) const;
};

/// One row. A cell that is blank, or whose column the table lacks, leaves its value alone. The
/// first error is kept, and nothing more is read.
class MachineTableRow {
 public:
  MachineTableRow(const MachineTable& table, std::int64_t number)
      : table_(table), number_(number) {}

  int number() const { return static_cast<int>(number_); }
  /// Empty where the table has no such column.
  std::string_view text(std::string_view column) const;
  void number(std::string_view column, double& value);
  void length(std::string_view column, double& millimetres);
  void whole(std::string_view column, int& value);

  /// Refuses what no machine can have.
  void check(const machine::Setup& setup);
  void fail(std::string_view column, std::string_view what);
  const std::optional<Error>& error() const { return error_; }

 private:
  std::optional<double> cell(std::string_view column);

  const MachineTable& table_;
  const std::int64_t number_;
  std::optional<Error> error_;
};

}  // namespace fitgauge::app
