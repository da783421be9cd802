#pragma once

#include "nc/klartext/syntax.hpp"

namespace fitgauge::interpreter {

/// A fault of a program that no other calls: the caller may give the corner.
inline constexpr std::string_view kNoLowerCorner =
    "BLK FORM 0.2 stands without BLK FORM 0.1 before it";

/// Whether one of the first thousand blocks is a BLK FORM 0.1, for the programs that this one
/// calls.
bool has_lower_corner(const klartext::Program& program);

using BlankValue = std::function<std::optional<double>(const klartext::Expr&)>;

/// The faults of a BLK FORM 0.1 or 0.2 and its other corner. Empty for other blocks. @param
/// value of what is no number, or nothing if it is unknown
std::vector<std::string> blank_faults(const klartext::Program& program,
                                      const klartext::Block& block, const BlankValue& value);

/// Whether the block has a fault, or may have one with values of the run.
bool may_have_blank_fault(const klartext::Program& program, const klartext::Block& block);

}  // namespace fitgauge::interpreter
