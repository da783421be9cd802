#pragma once

#include "nc/probing/cycle_descriptor.hpp"

namespace fitgauge::interpreter {

using machine::FaultKind;
using NcError = machine::MachineFault;
template <class T>
using NcResult = machine::MachineResult<T>;

using probing::nc_error;  // of the control's list: "Touch point inaccessible: detail"
/// An error of the program without a number of the control's.
inline NcError nc_error(std::string text) { return {FaultKind::Error, 0, std::move(text)}; }
template <class First, class... Rest>
NcError nc_error(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest) {
  return nc_error(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
}
template <class... Parts>
NcError limit_error(fmt::format_string<Parts...> text, Parts&&... parts) {
  return {FaultKind::Limit, 0, fmt::format(text, std::forward<Parts>(parts)...)};
}
/// A missing row, a path outside the disk and the like.
inline NcError nc_error(const Error& error) {
  return nc_error(error.where.empty() ? error.message : error.where + ": " + error.message);
}

/// The end that an error gives a run: Error, Stop, Limit or Cancelled.
constexpr FaultKind ending_of(FaultKind kind) {
  return kind > FaultKind::Cancelled ? FaultKind::Error : kind;
}

}  // namespace fitgauge::interpreter
