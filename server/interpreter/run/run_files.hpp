#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "program/control_disk.hpp"
#include "run/nc_error.hpp"
#include "run/run_log.hpp"

namespace fitgauge::interpreter {

/// The control's disk as this run has left it: what it wrote lies over what is stored, and stays
/// in the run. Not thread-safe.
class RunFiles {
 public:
  /// @param disk must outlive this object, as must `budget`.
  RunFiles(const ControlDisk& disk, OutputBudget& budget, std::size_t most_files)
      : disk_(disk), budget_(budget), most_files_(most_files) {}

  std::optional<ControlFile> find(const ControlPath& path) const;
  bool has_directory(std::string_view directory) const;

  /// @errors limit: output or number of files.
  NcResult<void> write(const ControlPath& path, std::string bytes);
  /// Adds to a file of the run, or to what is stored of it. @errors as write.
  NcResult<void> append(const ControlPath& path, std::string_view bytes);

  std::vector<WrittenFile> take();

 private:
  struct Written {
    ControlPath path;
    std::string bytes;
    unsigned revision = 0;
  };
  NcResult<Written*> entry(const ControlPath& path);

  const ControlDisk& disk_;
  OutputBudget& budget_;
  std::size_t most_files_;
  std::map<std::string, Written> written_;  // by key
};

}  // namespace fitgauge::interpreter
