#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "cli/outcome.hpp"

namespace fitgauge::cli {

/// A file to be written, or standard output. A file is written beside its name (`.NAME.XXXXXX`) and
/// renamed by finish(): until then, and when anything fails, an earlier file of that name stays as
/// it is. A device or a pipe is written to directly.
class OutputFile {
 public:
  /// @param path empty or `-` is standard output. Nothing is opened before the first write.
  explicit OutputFile(std::string path) : path_(std::move(path)) {}
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// @returns whether everything was written so far.
  bool write(std::string_view bytes);
  /// Gives the file its name. @errors LocalFile: all of it was not written, and why.
  Outcome<void> finish();

 private:
  bool open();

  const std::string path_;
  std::string target_;  ///< behind a link
  std::string draft_;   ///< empty: written to directly
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::string failure_;
};

/// Writes a file in one piece, or standard output for `-`. @errors LocalFile
Outcome<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace fitgauge::cli
