#pragma once

#include "nc/klartext/statement.hpp"
#include "nc/machine/axis.hpp"
#include "nc/program/control_disk.hpp"
#include "nc/program/machining_cycles.hpp"

namespace fitgauge::interpreter {

/// A machining cycle with the values of its block, defaults included, in mm, mm/min, degrees and
/// seconds, by the number of their parameter. A feed of infinity is FMAX.
struct MachiningDefinition {
  const MachiningCycle* cycle = nullptr;
  std::map<int, double> values{};
  std::set<int> given{};  ///< the parameters that the block names
  std::string text{};     ///< QS500

  double value(int parameter, double otherwise = 0) const {
    const auto it = values.find(parameter);
    return it == values.end() ? otherwise : it->second;
  }
  bool gives(int parameter) const { return given.contains(parameter); }
};

/// A cycle of the machine builder that the setup ignores.
struct IgnoredCycle {};

/// The target of CYCL CALL, M99 and M89: the last call-active cycle, a machining cycle or a program
/// (CYCL DEF 12); and what cycles and PATTERN DEF leave for it.
struct ActiveCycle {
  std::variant<std::monostate, MachiningDefinition, ControlPath, IgnoredCycle> definition;
  bool after_every_block = false;  ///< M89
  /// Numbers for FN 18 ID 10: the last call-active cycle and the last TCH PROBE.
  int number = -1;
  int last_probing = -1;
  std::vector<machine::Vec3> pattern{};               ///< PATTERN DEF: X, Y, and in Z its surface
  std::vector<klartext::Label> contours{};            ///< cycle 14
  std::optional<MachiningDefinition> contour_data{};  ///< cycle 20
};

}  // namespace fitgauge::interpreter
