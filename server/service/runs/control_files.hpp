#pragma once

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

}  // namespace fitgauge::app
