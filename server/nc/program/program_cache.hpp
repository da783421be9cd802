#pragma once

#include <list>
#include <unordered_map>

#include "base/allowance.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/program/linked_program.hpp"

namespace fitgauge::interpreter {

/// A file that a program names literally.
struct FileReference {
  enum class Kind : std::uint8_t { Program, Table, Mask };
  Kind kind = Kind::Program;
  std::string written;
  Diagnostic place;  ///< warning for a missing file, without its message
  /// Columns that FN 28 reads, such as `A,B`, and the row if it is a number.
  std::string columns{};
  std::optional<std::int64_t> row{};
};

/// A program file, ready to run, with all that was found in it.
struct LinkedFile {
  const std::shared_ptr<const LinkedProgram>& runnable(bool keeps_unreadable) const {
    return keeps_unreadable ? with_error_blocks : program;
  }

  std::shared_ptr<const LinkedProgram> program;  ///< null when a diagnostic is an error
  /// The program, with ERROR blocks for lines that are not Klartext (decision 32); null after other
  /// errors.
  std::shared_ptr<const LinkedProgram> with_error_blocks;
  std::vector<Diagnostic> diagnostics;    ///< of the parser and the linker
  std::vector<FileReference> references;  ///< the first 1000
  std::size_t memory_bytes = 0;           ///< its approximate memory
};

/// Resolves labels, jumps, repeats and cycles and lowers the formulas of a parsed program.
/// Errors: unknown and duplicate labels, cycle parameters that the cycle does not have or whose
/// value is out of range. Warnings: CALL LBL REP before its label, and what fails only when its
/// block is reached (cycles and M functions that are not available). A program that is named is not
/// looked for; see check.
LinkedFile link(klartext::ParsedProgram parsed, const ControlPath& path);

/// Programs parsed and linked once for each revision of their file, the least recently used dropped
/// beyond a size. Thread-safe; two threads that miss at once both link, and one result is stored.
class ProgramCache {
 public:
  explicit ProgramCache(std::size_t bytes = std::size_t{32} << 20) : capacity_(bytes) {}

  /// Returns the linked file, even with errors; null if the path does not exist. The disk reads its
  /// bytes only if they are not cached.
  std::shared_ptr<const LinkedFile> get(const ControlDisk& disk, const ControlPath& path);
  /// Returns the linked form of a file that was read. Never null.
  std::shared_ptr<const LinkedFile> get(ControlFile file);

 private:
  std::shared_ptr<const LinkedFile> at_hand(const std::string& key);

  struct Entry {
    std::string key;
    std::shared_ptr<const LinkedFile> file;
  };

  const std::size_t capacity_;
  std::mutex mutex_;
  std::list<Entry> entries_;  // the most recently used first
  std::unordered_map<std::string, std::list<Entry>::iterator> index_;
  std::size_t bytes_ = 0;
};

/// Returns all findings in a program and every program that it names literally, without running
/// anything. Errors prevent a run; warnings are failures of a block that may be reached: a missing
/// program, table or mask, an unavailable cycle or M function, an ERROR block. Programs that are
/// reached after `allowance` is spent are not checked, with a warning.
/// @errors ProgramUnknown if there is no such file.
Result<std::vector<Diagnostic>> check(const ControlPath& program, const ControlDisk& disk,
                                      ProgramCache& programs, Allowance& allowance);

}  // namespace fitgauge::interpreter
