#pragma once

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/parser.hpp"
#include "nc/program/linked_program.hpp"

namespace fitgauge::interpreter {

/// A file that a program names literally.
struct FileReference {
  enum class Kind : std::uint8_t { Program, Table, Mask };
  Kind kind = Kind::Program;
  std::string written;
  klartext::Diagnostic place;  ///< warning for a missing file, without its message
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
  std::vector<klartext::Diagnostic> diagnostics;  ///< of the parser and the linker
  std::vector<FileReference> references;          ///< the first 1000
  std::size_t memory_bytes = 0;                   ///< its approximate memory
};

/// Resolves labels, jumps, repeats and cycles and lowers the formulas of a parsed program.
/// Errors: unknown and duplicate labels, cycle parameters that the cycle does not have or whose
/// value is out of range. Warnings: CALL LBL REP before its label, and what fails only when its
/// block is reached (cycles and M functions that are not available). A program that is named is not
/// looked for; see check.
LinkedFile link(klartext::ParsedProgram parsed, const ControlPath& path);

}  // namespace fitgauge::interpreter
