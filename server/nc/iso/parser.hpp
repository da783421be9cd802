#pragma once

#include "nc/klartext/parser.hpp"

namespace fitgauge::iso {

/// Whether a text is DIN/ISO: its first block begins with `%`, or the file is called `.i` and it
/// does not begin with BEGIN PGM.
bool is_iso(std::string_view text, std::string_view name);

/// Reads a program of either dialect. DIN/ISO gives the blocks of its Klartext, with places and
/// findings of the DIN/ISO text. Never throws on bad input.
/// @param name the file's name, for diagnostics.
klartext::ParsedProgram parse_program(std::string bytes, std::string name);

/// A program in the other dialect.
struct Conversion {
  std::string text;
  /// Blocks without a form there, which are errors, and calls that mean another file there.
  std::vector<klartext::Diagnostic> findings{};
};

/// Writes a program as DIN/ISO: reading it back gives the same blocks. A block without G codes
/// stays Klartext if its first word has more than one letter.
/// @param extension `.H` of a Klartext program, for called programs without an extension
/// @pre the program has no errors
Conversion to_iso(const klartext::Program& program, std::string_view extension);

/// A program that was read from DIN/ISO as Klartext, numbered from 0.
/// @param extension `.I`, likewise
/// @pre the program has no errors
Conversion to_klartext(const klartext::Program& program, std::string_view extension);

}  // namespace fitgauge::iso
