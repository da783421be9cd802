#pragma once

#include "nc/run/q_parameters.hpp"
#include "nc/run/run_files.hpp"
#include "tables/tabfile/tab_table.hpp"

namespace fitgauge::interpreter {

/// Tables of a run: the freely definable table that FN 26 has open (one at a time), and the datum
/// table. Each file is read once in a run. When the table is closed, the changes of FN 27 go to the
/// run's files. Not thread-safe.
class TableAccess {
 public:
  /// All must outlive this object.
  TableAccess(RunFiles& files, QParameters& parameters, Allowance& allowance)
      : files_(files), parameters_(parameters), allowance_(allowance) {}

  /// FN 26; closes the open table. @errors missing or malformed file, limit.
  NcResult<void> open(const ControlPath& path);
  /// FN 28. @param length_unit mm in one unit of the program's lengths. @errors no table open,
  /// missing row or column, empty or non-numeric cell.
  NcResult<void> read(QRef first, std::int64_t row, std::string_view columns,
                      double length_unit) const;
  /// FN 27. @errors as read.
  NcResult<void> write(QRef first, std::int64_t row, std::string_view columns, double length_unit);

  /// The name of the open table without its folder; empty: none is open.
  std::string_view open_name() const {
    return open_ ? open_->path.file_name() : std::string_view();
  }

  /// SEL TABLE. @errors as open.
  NcResult<void> select_datum_table(const ControlPath& path);
  bool has_datum_table() const { return datum_.has_value(); }
  /// The values of a row that are not blank: mm and degrees. @errors 1043, missing row.
  NcResult<machine::AxisWords> datum(std::int64_t row) const;
  /// @errors 1043, missing row or column.
  NcResult<void> write_datum(std::int64_t row, const machine::AxisWords& values);

  /// A number that FN 27 has written into tool.t: mm for lengths.
  struct ToolCell {
    int tool = 0;
    std::int64_t nr = 0;  ///< of the column, as FN 17 ID50 counts
    double value = 0;
  };
  /// Returns the numbers since the last call.
  std::vector<ToolCell> take_tool_cells() { return std::exchange(tool_cells_, {}); }

  /// Writes the changes. @errors limit.
  NcResult<void> close();
  const std::vector<OpenedTable>& opened() const { return opened_; }

 private:
  struct Table {
    ControlPath path;
    std::shared_ptr<const tabfile::TabTable> content;
    std::shared_ptr<tabfile::TabTable> changed = nullptr;  ///< the copy that is written to, if any
  };
  struct Known {
    std::string revision;
    std::shared_ptr<const tabfile::TabTable> content;
  };

  NcResult<Table> load(const ControlPath& path, std::string_view what);
  NcResult<void> save(std::optional<Table>& table);
  /// The content to change: a copy of the file's.
  static tabfile::TabTable& editable(Table& table);

  RunFiles& files_;
  QParameters& parameters_;
  Allowance& allowance_;
  std::optional<Table> open_;
  std::optional<Table> datum_;
  std::map<std::string, Known> known_;  // by key
  std::vector<OpenedTable> opened_;
  std::vector<ToolCell> tool_cells_;
};

}  // namespace fitgauge::interpreter
