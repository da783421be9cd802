#pragma once

#include <doctest/doctest.h>

#include "nc/machine/fault.hpp"
#include "unit/nc/machine/vec_check.hpp"

namespace fitgauge::machine {

/// Whether a command succeeded; says why when it did not.
template <class T>
bool ok(const MachineResult<T>& result) {
  if (result.has_error()) MESSAGE(result.error().text);
  return result.has_value();
}

template <class T>
FaultKind fault_of(const MachineResult<T>& result) {
  REQUIRE(result.has_error());
  return result.error().kind;
}

}  // namespace fitgauge::machine
