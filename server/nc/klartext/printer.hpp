#pragma once

#include "nc/klartext/syntax.hpp"

namespace fitgauge::klartext {

/// The program as Klartext, one blank between words, lines ending with LF. Reading it back gives an
/// equal program. Numbers are printed with the fewest digits that give the same value.
std::string print_program(const Program& program);

/// Prints a program with blocks numbered from 0, as a control lists it.
std::string format_program(const Program& program);

/// One block without skip mark, number and comment; a cycle with its comments.
std::string print_statement(const Program& program, const Block& block);

}  // namespace fitgauge::klartext
