#pragma once

#include <string>
#include <vector>

#include "base/allowance.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/program/program_cache.hpp"

namespace fitgauge::app {

/// Everything there is to say about a file of the control's disk, by its kind: a mask (`.a`), a
/// table (`.tab`, `.t`, `.tp`, `.pr`, `.d`), or else a program with those it calls.
/// @errors ProgramUnknown when there is no such file.
Result<std::vector<klartext::Diagnostic>> check_file(const interpreter::ControlPath& path,
                                                     const interpreter::ControlDisk& disk,
                                                     interpreter::ProgramCache& programs,
                                                     Allowance& allowance);

/// A program as a control lists it: one blank between words, blocks numbered from 0.
/// @errors ProgramUnknown; ProgramInvalid with the first line that cannot be read.
Result<std::string> format_file(const interpreter::ControlPath& path,
                                const interpreter::ControlDisk& disk);

}  // namespace fitgauge::app
