#pragma once

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::interpreter {

/// GLOBAL DEF 100, 105, 110, 111, 120 and 125: the values that PREDEF takes (decision 23). Static
/// data; null for another number.
const probing::CycleDescriptor* global_definition(int number);

/// The GLOBAL DEF that has a value for `Q320=PREDEF`, or null where no PREDEF may stand.
const probing::CycleDescriptor* global_definition_of(int parameter);

}  // namespace fitgauge::interpreter
