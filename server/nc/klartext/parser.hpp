#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {

/// Beyond these the text is refused with ProgramTooLarge; they bound the memory of a parse.
inline constexpr std::size_t kLargestSource = std::size_t{64} << 20;
inline constexpr std::size_t kMostBlocks = 500'000;
/// Empty ones, those of comments and those that a `~` continues among them.
inline constexpr std::size_t kMostLines = 1'000'000;
/// Bytes of a program with its source, blocks, words and formulas, its code included. No run holds
/// more.
inline constexpr std::size_t kMostMemory = std::size_t{48} << 20;

/// The message of a program beyond kMostMemory.
std::string too_much_memory();

struct ParsedProgram {
  Program program;
  std::vector<Diagnostic> diagnostics{};  ///< in the order of the source

  bool has_errors() const;
  /// The first finding because of which a printed program would lose text; null: there is none.
  const Diagnostic* not_printed() const;
};

/// Reads a Klartext program: UTF-8 with or without byte order mark, or Windows-1252 when it is not
/// valid UTF-8; lines end with CRLF, LF or CR. Goes on at the next block after an error, so that
/// all findings of a file are reported at once. Never throws on bad input.
/// @param name the file's name, for diagnostics.
ParsedProgram parse_program(std::string bytes, std::string name);

/// The words that blocks begin with, those of features that are not available too; axes, `*` and
/// parameters begin blocks as well.
std::vector<std::string_view> block_keywords();

}  // namespace fitgauge::klartext
