#pragma once

#include "base/result.hpp"
#include "nc/machine/fault.hpp"
#include "nc/probing/cycle_fault.hpp"
#include "nc/program/control_disk.hpp"

namespace fitgauge::interpreter {

enum class NcErrorKind : std::uint8_t {
  Error,      ///< of the program or the machine: the run fails
  Stop,       ///< the run ends as the operator wants it (on_stop) or as Q309 asks for
  Limit,      ///< a budget of the run is used up
  Cancelled,  ///< from outside
};

/// Reason why a run ends at a block. A value, never an exception; the executor adds the place. The
/// enum class stays first: see fitgauge::Error.
struct NcError {
  NcErrorKind kind{};
  int number = 0;  ///< the control's error number (FN 14 and 1000 to 1199), 0 without one
  std::string text;
};

/// An error of the program without a number of the control's.
NcError nc_error(std::string text);
/// An error of the control's list: "Touch point inaccessible: detail".
NcError nc_error(int number, std::string_view detail = {});
NcError limit_error(std::string text);
NcError from_machine(const machine::MachineFault& fault);
NcError from_cycle(const probing::CycleFault& fault);
/// A missing row, a path outside the disk and the like.
NcError from_error(const Error& error);

[[noreturn]] void throw_bad_nc_result(const NcError& error);

/// Boost's hook: reading the value of a failed result is a bug.
[[noreturn]] inline void throw_exception_from_error(const NcError& error,
                                                    const boost::source_location&) {
  throw_bad_nc_result(error);
}

template <class T>
using NcResult = boost::system::result<T, NcError>;

/// Converts the result of a machine command to one of the interpreter.
inline NcResult<void> checked(const machine::MachineResult<void>& result) {
  if (result.has_error()) return from_machine(result.error());
  return {};
}

/// The replacement of an M function or cycle of the machine builder: a program, or nothing.
struct BuilderAction {
  std::optional<ControlPath> program;
};

/// M functions and cycles of the machine builder, as in the setup (decision 28). Functions of the
/// control itself cannot be replaced.
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
