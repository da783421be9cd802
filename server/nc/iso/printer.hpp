#pragma once

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::iso {

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
