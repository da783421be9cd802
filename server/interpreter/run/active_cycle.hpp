#pragma once

#include <map>
#include <variant>

#include "program/control_path.hpp"
#include "program/cycle_names.hpp"

namespace fitgauge::interpreter {

/// The values of a drilling cycle, in mm, mm/min and seconds, by the number of their parameter.
/// A feed of infinity is FMAX.
struct DrillingDefinition {
  const DrillingCycle* cycle = nullptr;
  std::map<int, double> values;

  double value(int parameter, double otherwise = 0) const {
    const auto it = values.find(parameter);
    return it == values.end() ? otherwise : it->second;
  }
};

/// What CYCL CALL, M99 and M89 run: the last call-active cycle, a drilling cycle or a program
/// (CYCL DEF 12).
struct ActiveCycle {
  std::variant<std::monostate, DrillingDefinition, ControlPath> definition;
  bool after_every_block = false;  ///< M89
  /// Numbers for FN 18 ID 10: the last call-active cycle and the last TCH PROBE.
  int number = -1;
  int last_probing = -1;
};

}  // namespace fitgauge::interpreter
