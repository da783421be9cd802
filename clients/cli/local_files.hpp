#pragma once

#include <cstdio>

#include "base/folder.hpp"
#include "cli/outcome.hpp"

namespace fitgauge::cli {

/// An open file or standard input, read once from its begin.
class InputFile {
 public:
  /// @param path `-` is standard input. @errors LocalFile
  static Outcome<InputFile> open(const std::string& path);

  /// 0 at the end. @errors LocalFile
  Outcome<std::size_t> read(std::span<char> into);

  /// Size of a regular file.
  std::optional<std::uint64_t> size() const;

  /// Returns to the begin of the file. @errors LocalFile
  Outcome<void> rewind();

 private:
  friend Outcome<InputFile> open_to_read_again(const std::string& path);

  InputFile(std::string name, int opened) : name_(std::move(name)), file_(opened) {}

  std::string name_;
  Descriptor file_;
};

/// Opens a file, or copies a pipe to a file without a name, to read it more than once.
/// @errors LocalFile
Outcome<InputFile> open_to_read_again(const std::string& path);

/// The whole of a file, or of standard input for `-`. @errors LocalFile
Outcome<std::string> read_file(const std::string& path);

/// Replaces no file without consent: of the user, or by `force`.
/// @errors LocalFile without consent.
Outcome<void> may_replace(const std::string& path, bool force);

/// An output file, or standard output. A file is written to a temporary name (`.NAME.XXXXXX`) and
/// renamed by finish(): until then, and after a failure, an earlier file of that name is unchanged.
/// A signal that ends the process removes the temporary file: there is one at a time. An open
/// descriptor (/dev/stdout), a device or a pipe is written to directly.
class OutputFile {
 public:
  /// @param path empty or `-` is standard output. Nothing is opened before the first write.
  explicit OutputFile(std::string path) : path_(std::move(path)) {}
  OutputFile& operator=(OutputFile&&) = delete;  // neither copied nor moved
  ~OutputFile();

  /// @returns whether everything was written so far.
  bool write(std::string_view bytes);
  /// Gives the file its name. @errors LocalFile if not all of it was written, with the reason.
  Outcome<void> finish();

 private:
  bool open();
  bool open(int descriptor);

  const std::string path_;
  std::string target_;  ///< target of a link
  std::string draft_;   ///< empty: written to directly
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_{nullptr, &std::fclose};
  std::string failure_;
};

/// Writes a file in one piece, or standard output for `-`. @errors LocalFile
Outcome<void> write_file(const std::string& path, std::string_view bytes);

}  // namespace fitgauge::cli
