#pragma once

#include <cstddef>
#include <string>

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::interpreter {

/// Findings beyond this number are not kept.
inline constexpr std::size_t kMostFindings = 200;

/// A finding about a place of a program: by default a block, as far as its first physical line
/// goes.
klartext::Diagnostic diagnose(const klartext::Program& program, const klartext::Block& block,
                              klartext::Severity severity, klartext::DiagnosticCode code,
                              std::string message);
klartext::Diagnostic diagnose(const klartext::Program& program, const klartext::Block& block,
                              klartext::Slice<char> place, klartext::Severity severity,
                              klartext::DiagnosticCode code, std::string message);

/// The member of the setup that makes an M function or a cycle of the machine builder known, as a
/// hint in the messages of checks and runs.
std::string m_function_hint(int number);
std::string cycle_hint(bool is_probing, int number);

/// Whether the M function is one of the control's; what a machine builder adds is not available.
bool is_m_function(int number);

}  // namespace fitgauge::interpreter
