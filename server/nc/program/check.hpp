#pragma once

#include "base/allowance.hpp"
#include "nc/program/program_cache.hpp"

namespace fitgauge::interpreter {

/// Returns all findings in a program and every program that it names literally, without running
/// anything. Errors prevent a run; warnings are failures of a block that may be reached: a missing
/// program, table or mask, an unavailable cycle or M function, an ERROR block. Programs that are
/// reached after `allowance` is spent are not checked, with a warning.
/// @errors ProgramUnknown if there is no such file.
Result<std::vector<klartext::Diagnostic>> check(const ControlPath& program, const ControlDisk& disk,
                                                ProgramCache& programs, Allowance& allowance);

/// @param keeps_unreadable lines that are no Klartext are ERROR blocks and no errors (decision 32).
bool has_errors(const std::vector<klartext::Diagnostic>& diagnostics,
                bool keeps_unreadable = false);

}  // namespace fitgauge::interpreter
