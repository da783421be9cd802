#pragma once

#include <vector>

#include "nc/klartext/diagnostic.hpp"
#include "nc/klartext/syntax.hpp"

namespace fitgauge::interpreter {

/// Adds what a program says against itself, as warnings: a dialog text or comment that means
/// another cycle or parameter, depths and heights of the wrong sign or order, limits far from the
/// nominal size, a cutter or a turning spindle that probes, results that no cycle gives, parameters
/// behind a line without `~`. A parameter that is a number on the way to a cycle, or when its label
/// is called, counts as that number; the finding stands where it is set. Then drops the notes and
/// warnings that a comment switches off: `check:ignore`, alone or with codes behind it, in the line
/// or in the comment line above it.
void check_contradictions(const klartext::Program& program,
                          std::vector<klartext::Diagnostic>& diagnostics);

}  // namespace fitgauge::interpreter
