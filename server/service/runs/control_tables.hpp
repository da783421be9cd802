#pragma once

#include "base/allowance.hpp"
#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"

namespace fitgauge::app {

/// The rows of the control's own tool, probe and preset tables.
struct ControlTables {
  std::vector<machine::ToolSetup> tools;
  std::vector<machine::ProbeSetup> probes;
  std::vector<machine::Preset> presets;
};

/// Reads `tool.t`, `tchprobe.tp` and `preset.pr` of the control's disk, if they exist: in
/// `TNC:\table\`, else in `TNC:\`. Missing columns and blank cells have the value of a new row;
/// lengths of a table in inches become millimetres. Indexed tools (5.1) are left out, because no
/// tool call reaches them.
/// @errors TableFileMalformed with the file and its line or row.
Result<ControlTables> read_control_tables(const interpreter::ControlDisk& disk,
                                          Allowance& allowance);

/// Caches the tables of one disk; reads them again only after a file has changed. Used by one
/// thread.
class ControlTablesCache {
 public:
  /// @param disk outlives the cache
  explicit ControlTablesCache(const interpreter::ControlDisk& disk) : disk_(disk) {}
  /// @errors as read_control_tables.
  Result<std::shared_ptr<const ControlTables>> read(Allowance& allowance);

 private:
  const interpreter::ControlDisk& disk_;
  std::string revisions_;
  std::shared_ptr<const ControlTables> tables_;
};

/// Tables that a setup defines; the others have default rows.
struct GivenTables {
  bool tools = false;
  bool probes = false;
  bool presets = false;
};

/// Adds the control's rows to the rows of a setup. If both have a number, the setup's row counts,
/// unless it is a default row.
void add_rows(const ControlTables& tables, const GivenTables& given, machine::MachineSetup& setup);

}  // namespace fitgauge::app
