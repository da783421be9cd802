#pragma once

#include "nc/probing/cycle_host.hpp"
#include "nc/run/run_log.hpp"

namespace fitgauge::interpreter {

/// The control's disk after this run: its files cover the stored ones, and stay in the run. Not
/// thread-safe.
class RunFiles final : public ControlDisk {
 public:
  /// @param disk must outlive this object, as must `budget`.
  RunFiles(const ControlDisk& disk, OutputBudget& budget, std::size_t most_files)
      : disk_(disk), budget_(budget), most_files_(most_files) {}

  std::optional<ControlFile> find(const ControlPath& path) const override;
  /// Revision of the file of `find`, without reading its bytes.
  std::optional<std::string> revision(const ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

  /// Counts a file that will be written later. @errors limit: number of files.
  NcResult<void> reserve(const ControlPath& path);
  /// @errors limit: output or number of files.
  NcResult<void> write(const ControlPath& path, std::string bytes);
  /// Appends to a file of the run, or to a copy of the stored file. @errors as write.
  NcResult<void> append(const ControlPath& path, std::string_view bytes);

  /// Copies of all that was written until now.
  std::vector<WrittenFile> copies() const;
  std::vector<WrittenFile> take();

 private:
  struct Written {
    ControlPath path;
    std::shared_ptr<std::string> bytes;  ///< not to be changed while others have found the file
    unsigned revision = 0;

    std::string revision_text() const { return "run-" + std::to_string(revision); }
  };

  const ControlDisk& disk_;
  OutputBudget& budget_;
  std::size_t most_files_;
  std::set<std::string> reserved_;          // keys of all that is or will be written
  std::map<std::string, Written> written_;  // by key
};

// kinematics_records.cpp
/// Reads the records of cycle 450 in `TNC:\table\DATA450.KD`: a row for each axis of a record and
/// one for the tool, with a point and a direction. None without this file.
/// @errors 1096 the file is not such a table.
NcResult<probing::KinematicsRecords> read_kinematics_records(const RunFiles& files,
                                                             Allowance& allowance);

/// Replaces that file. @errors as RunFiles::write.
NcResult<void> write_kinematics_records(RunFiles& files, const probing::KinematicsRecords& records);

}  // namespace fitgauge::interpreter
