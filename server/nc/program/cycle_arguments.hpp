#pragma once

#include <optional>

#include "nc/klartext/syntax.hpp"
#include "nc/probing/arguments.hpp"

namespace fitgauge::interpreter {

inline constexpr double kMillimetresPerInch = 25.4;

/// How many mm, degrees or mm/min one unit of a cycle parameter is: 25.4 for the lengths of an INCH
/// program, 2.54 for its feeds (tenths of an inch a minute).
double scale_of(probing::Unit unit, bool is_inch);

/// The value of a cycle parameter as far as it is known before the program runs: numbers and texts
/// written out. Nothing for parameters, formulas and PREDEF.
std::optional<probing::ArgumentValue> literal(const klartext::Program& program,
                                              const klartext::CycleParameter& written,
                                              const probing::CycleParameter& parameter);

/// The descriptor's parameter that `Q262=` or `QS400=` of a block means, or null.
const probing::CycleParameter* find_parameter(const probing::CycleDescriptor& descriptor,
                                              klartext::QRef written);

}  // namespace fitgauge::interpreter
