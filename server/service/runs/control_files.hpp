#pragma once

#include "base/allowance.hpp"
#include "nc/machine/machine_setup.hpp"
#include "nc/program/control_disk.hpp"
#include "tables/iso286/tolerance_tables.hpp"

namespace fitgauge::app {

/// The treatment of a missing file: a setup may be stored before its parts are.
enum class MissingFiles : std::uint8_t { Allowed, Refused };

/// STL files of one disk. A mesh that an order holds is not read again, so orders of one part share
/// it. Used by one thread.
class MeshFiles {
 public:
  /// The most triangles of one workpiece, in about 25 MB.
  static constexpr std::size_t kMostTriangles = 200'000;

  /// @param disk outlives this.
  explicit MeshFiles(const interpreter::ControlDisk& disk) : disk_(disk) {}

  /// Loads the meshes of the setup.
  /// @param pointer of the setup in its request
  /// @errors RequestInvalid with one detail for each file: FileUnknown, or FieldInvalid if it is
  ///   not a closed mesh or has too many triangles.
  Result<void> load(machine::Setup& setup, std::string_view pointer, MissingFiles missing);

 private:
  using Body = std::shared_ptr<const machine::TriangleTree>;
  Result<Body> body_of(const machine::Mesh& mesh);

  const interpreter::ControlDisk& disk_;
  std::map<std::string, std::weak_ptr<const machine::TriangleTree>> known_;
};

class TableCatalog;

/// Returns 82553_hole.tab and 82553_shaft.tab with the contents of the tolerance tables.
std::vector<interpreter::ProjectingDisk::Projection> project(const iso286::ToleranceTables& tables);

/// Projects the tolerance tables in use, once for each revision. Thread-safe.
class LiveTables {
 public:
  /// @param catalog outlives this.
  explicit LiveTables(const TableCatalog& catalog) : catalog_(catalog) {}

  /// Both tables of one revision; none if the tables failed their audit.
  std::vector<interpreter::ProjectingDisk::Projection> projections();

 private:
  const TableCatalog& catalog_;
  std::mutex mutex_;
  std::string revision_;
  std::vector<interpreter::ProjectingDisk::Projection> projections_;
};

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
