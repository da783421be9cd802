#pragma once

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::interpreter {

/// Adds warnings for contradictions in a program: a dialog text or comment that means another cycle
/// or parameter, depths and heights of the wrong sign or order, limits far from the nominal size, a
/// cutter or a turning spindle that probes, results that no cycle gives, parameters after a line
/// without `~`. A parameter with a known number counts as that number; the finding is at its
/// assignment. Then drops the findings that a comment switches off.
void check_contradictions(const klartext::Program& program,
                          std::vector<klartext::Diagnostic>& diagnostics);

}  // namespace fitgauge::interpreter
