#pragma once

#include "nc/machine/control.hpp"
#include "nc/machine/simulated_axes.hpp"

namespace fitgauge::machine {

/// A control over axes that exist in a setup alone. Not thread-safe.
class SimulatedMachine final : public Control {
 public:
  /// @param allowance as of Control
  /// @pre validate(setup) succeeds.
  explicit SimulatedMachine(const Setup& setup, Allowance* allowance = nullptr)
      : Control(setup.machine, std::make_unique<SimulatedAxes>(setup), allowance) {}
};

}  // namespace fitgauge::machine
