#pragma once

#include <span>
#include <vector>

#include "nc/klartext/diagnostic.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/run_observer.hpp"

namespace fitgauge::interpreter {

/// The blocks that a failing block depends on, each with what it sets: the parameters that it
/// reads, those that they were computed from, and, as far as the error can come from them, the axes
/// that it leaves alone, the datum, the tool and the unit INCH. Of each the block that has run last
/// before it, as far as the calls of subprograms tell that.
/// @param chain the failing block, then the blocks behind the calls that lead to it
std::vector<klartext::DiagnosticNote> origins_of(std::span<const Place> chain,
                                                 const NcError& error);

/// The blocks that the values of a block depend on, if it measures or reads data of the control.
std::vector<klartext::DiagnosticNote> origins_of_values(std::span<const Place> chain);

}  // namespace fitgauge::interpreter
