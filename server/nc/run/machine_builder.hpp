#pragma once

#include <map>
#include <optional>

#include "nc/program/control_path.hpp"
#include "nc/run/nc_error.hpp"

namespace fitgauge::interpreter {

/// What stands for an M function or cycle of the machine builder: a program, or nothing at all.
struct BuilderAction {
  std::optional<ControlPath> program;
};

/// The M functions and cycles that only the builder of a machine knows, as its setup gives them
/// (decision 28). Those of the control itself cannot be replaced.
struct MachineBuilder {
  std::map<int, BuilderAction> m_functions;
  std::map<int, BuilderAction> cycles;

  const BuilderAction* m_function(int number) const { return find(m_functions, number); }
  const BuilderAction* cycle(int number) const { return find(cycles, number); }

 private:
  static const BuilderAction* find(const std::map<int, BuilderAction>& actions, int number) {
    const auto it = actions.find(number);
    return it == actions.end() ? nullptr : &it->second;
  }
};

/// The error of a block that needs an entry in that table, which names the setting.
NcError unknown_m_function(int number);
NcError unknown_cycle(bool is_probing, int number);

}  // namespace fitgauge::interpreter
