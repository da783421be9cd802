#pragma once

namespace fitgauge::machine {

/// Why a command, a cycle or a run ended. The first four end a run so; the others are what a
/// machine could not do, and end it as Error does.
enum class FaultKind : std::uint8_t {
  Error,      ///< of the program: the run fails
  Stop,       ///< the run ends as the operator wants it (on_stop) or as Q309 asks for
  Limit,      ///< a budget of the run is used up
  Cancelled,  ///< from outside
#define FITGAUGE_FAULT(kind, number, text) kind,
#include "nc/machine/fault_kinds.inc"
#undef FITGAUGE_FAULT
};

/// Reason why the machine could not execute a command, or why a cycle or the run ended. A value of
/// the run, never an exception; the executor adds the place. The enum class stays first: see
/// fitgauge::Error.
struct MachineFault {
  FaultKind kind{};
  int number = 0;    ///< the control's error number (FN 14, 1000 to 1199), 0 if it shows only text
  std::string text;  ///< the control's text, then the event and its place in mm

  friend bool operator==(const MachineFault&, const MachineFault&) = default;
};

/// The number and the control's text of a machine's kind: 1014 "Touch point inaccessible".
MachineFault make_fault(FaultKind kind, std::string_view detail = {});
template <class First, class... Rest>
MachineFault make_fault(FaultKind kind, fmt::format_string<First, Rest...> detail, First&& first,
                        Rest&&... rest) {
  return make_fault(kind,
                    fmt::format(detail, std::forward<First>(first), std::forward<Rest>(rest)...));
}

[[noreturn]] void throw_bad_machine_result(const MachineFault& fault);

/// Boost's hook: reading the value of a failed result is a bug.
[[noreturn]] inline void throw_exception_from_error(const MachineFault& fault,
                                                    const boost::source_location&) {
  throw_bad_machine_result(fault);
}

template <class T>
using MachineResult = boost::system::result<T, MachineFault>;

/// @faults ValueInvalid unless a condition holds.
inline MachineResult<void> require(bool holds, std::string_view detail) {
  return holds ? MachineResult<void>() : make_fault(FaultKind::ValueInvalid, detail);
}

}  // namespace fitgauge::machine
