#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "klartext/expression.hpp"
#include "machine/axis.hpp"
#include "program/control_path.hpp"
#include "run/nc_error.hpp"
#include "run/run_result.hpp"
#include "tabfile/tab_table.hpp"

namespace fitgauge::interpreter {

class Channel;

/// The tables of a run: the freely definable one that FN 26 has open (one at a time) and the datum
/// table. Each file is read once in a run; what FN 27 writes goes to the run's files when the table
/// is closed. Not thread-safe.
class TableAccess {
 public:
  /// FN 26; closes the one that is open. @errors missing or malformed file, limit.
  NcResult<void> open(Channel& channel, const ControlPath& path);
  /// FN 28. @errors no table open, missing row or column, empty or non-numeric cell.
  NcResult<void> read(Channel& channel, klartext::QRef first, std::int64_t row,
                      std::string_view columns) const;
  /// FN 27. @errors as read.
  NcResult<void> write(Channel& channel, klartext::QRef first, std::int64_t row,
                       std::string_view columns);

  /// SEL TABLE. @errors as open.
  NcResult<void> select_datum_table(Channel& channel, const ControlPath& path);
  bool has_datum_table() const { return datum_.has_value(); }
  /// The values of a row that are not blank: mm and degrees. @errors 1043, missing row.
  NcResult<machine::AxisWords> datum(std::int64_t row) const;
  /// @errors 1043, missing row or column.
  NcResult<void> write_datum(Channel& channel, std::int64_t row, const machine::AxisWords& values);

  /// Writes what has changed. @errors limit.
  NcResult<void> close(Channel& channel);
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

  NcResult<Table> load(Channel& channel, const ControlPath& path, std::string_view what);
  NcResult<void> save(Channel& channel, std::optional<Table>& table);
  /// The content to change: a copy of the file's.
  static tabfile::TabTable& editable(Table& table);

  std::optional<Table> open_;
  std::optional<Table> datum_;
  std::map<std::string, Known> known_;  // by key
  std::vector<OpenedTable> opened_;
};

}  // namespace fitgauge::interpreter
