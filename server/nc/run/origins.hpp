#pragma once

#include "nc/klartext/diagnostic.hpp"
#include "nc/run/nc_error.hpp"
#include "nc/run/run_observer.hpp"

namespace fitgauge::interpreter {

/// Returns the blocks that a failing block depends on, each with its effect: on the parameters that
/// the failing block reads, on the parameters these were computed from, and, if the error can come
/// from them, on axes that it does not move, datum, tool and unit INCH. Names for each the block
/// that ran last before it, as far as the calls of subprograms tell this.
/// @param chain the failing block, then the blocks after the calls that lead to it
std::vector<klartext::DiagnosticNote> origins_of(std::span<const Place> chain,
                                                 const NcError& error);

/// The blocks that the values of a block depend on, if it measures or reads data of the control.
std::vector<klartext::DiagnosticNote> origins_of_values(std::span<const Place> chain);

}  // namespace fitgauge::interpreter
