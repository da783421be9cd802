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

}  // namespace fitgauge::iso
