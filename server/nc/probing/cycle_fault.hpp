#pragma once

#include "nc/machine/fault.hpp"

namespace fitgauge::probing {

/// Reason why a cycle ended the run. Kind Stop is Q309: a measured value is out of tolerance; all
/// results are written.
using CycleFault = machine::MachineFault;

template <class T>
using CycleResult = machine::MachineResult<T>;

/// The control's text of an error number 1000 to 1109 (FN 14: ERROR), empty for others.
std::string_view error_text(int number);

/// An NC error: "Touch point inaccessible: detail".
CycleFault nc_error(int number, std::string_view detail = {});
template <class First, class... Rest>
CycleFault nc_error(int number, fmt::format_string<First, Rest...> detail, First&& first,
                    Rest&&... rest) {
  return nc_error(number,
                  fmt::format(detail, std::forward<First>(first), std::forward<Rest>(rest)...));
}
CycleFault tolerance_stop(int number);

}  // namespace fitgauge::probing
