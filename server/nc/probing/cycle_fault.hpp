#pragma once

#include "nc/machine/fault.hpp"

namespace fitgauge::probing {

enum class CycleFaultKind : std::uint8_t {
  Error,         ///< an NC error: the run fails
  ToleranceStop  ///< Q309: a measured value is out of tolerance; all results are written
};

/// Reason why a cycle ended the run: the control's error number and text. A value of the run, never
/// an exception. The enum class stays first: see fitgauge::Error.
struct CycleFault {
  CycleFaultKind kind{};
  int number = 0;    ///< 1000 to 1199, 0 if the control shows only text
  std::string text;  ///< the control's text, then what happened
  std::optional<machine::FaultKind> of_machine{};  ///< if the machine has refused a command

  friend bool operator==(const CycleFault&, const CycleFault&) = default;
};

/// The control's text of an error number 1000 to 1109 (FN 14: ERROR), empty for others.
std::string_view error_text(int number);

/// An NC error: "Touch point inaccessible: detail".
CycleFault nc_error(int number, std::string_view detail = {});
CycleFault tolerance_stop(int number);
CycleFault from_machine(const machine::MachineFault& fault);

[[noreturn]] void throw_bad_cycle_result(const CycleFault& fault);

/// Boost's hook: reading the value of a failed result is a bug.
[[noreturn]] inline void throw_exception_from_error(const CycleFault& fault,
                                                    const boost::source_location&) {
  throw_bad_cycle_result(fault);
}

template <class T>
using CycleResult = boost::system::result<T, CycleFault>;

}  // namespace fitgauge::probing
