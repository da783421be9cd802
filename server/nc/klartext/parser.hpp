#pragma once

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {

/// Beyond these the text is refused with ProgramTooLarge; they bound the memory of a parse.
inline constexpr std::size_t kLargestSource = std::size_t{64} << 20;
inline constexpr std::size_t kMostBlocks = 500'000;
/// Maximum number of lines, with empty ones, comments and lines that a `~` continues.
inline constexpr std::size_t kMostLines = 1'000'000;
/// Maximum bytes of a program: its source, blocks, words, formulas and code. No run may use more.
inline constexpr std::size_t kMostMemory = std::size_t{48} << 20;

/// The message of a program beyond kMostMemory.
std::string too_much_memory();

struct ParsedProgram {
  Program program;
  std::vector<Diagnostic> diagnostics{};  ///< in the order of the source

  bool has_errors() const;
  /// Returns the first finding that makes a printed program lose text; null if there is none.
  const Diagnostic* not_printed() const;
};

/// Reads a Klartext program: UTF-8 with or without byte order mark, or Windows-1252 if it is not
/// valid UTF-8; lines end with CRLF, LF or CR. Continues with the next block after an error, so
/// that all findings of a file are reported at once. Never throws on bad input.
/// @param name the file's name, for diagnostics.
ParsedProgram parse_program(std::string bytes, std::string name);

/// The first words of blocks, also of unavailable features; `*`, axes and parameters begin some.
std::vector<std::string_view> block_keywords();

/// The program as Klartext, one blank between words, lines ending with LF. Reading it back gives an
/// equal program. Numbers are printed with the fewest digits that give the same value.
std::string print_program(const Program& program);

/// Prints a program with blocks numbered from 0, as a control lists it.
std::string format_program(const Program& program);

/// One block without skip mark, number and comment; a cycle with its comments.
std::string print_statement(const Program& program, const Block& block);

}  // namespace fitgauge::klartext
