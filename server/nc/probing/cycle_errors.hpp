#pragma once

#include <set>

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::probing {

/// The numbered errors that a cycle may end with: those of its values, of the state it needs, of
/// what it touches, of Q309. `run_cycle` asserts that there are no others.
std::set<int> errors_of(const CycleDescriptor& cycle);

}  // namespace fitgauge::probing
