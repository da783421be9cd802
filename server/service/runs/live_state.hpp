#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "nc/machine/axis.hpp"
#include "nc/run/run_result.hpp"

namespace fitgauge::app {

/// What a control shows of its machine while a program runs, at one moment between two blocks.
struct LiveState {
  std::string program{};    ///< the one that runs now, called or main
  std::uint32_t block = 0;  ///< its number, as written or counted
  /// Of the tool tip in the active coordinate system, mm and degrees; the machine's axes alone.
  std::vector<std::pair<machine::Axis, double>> axes{};
  int tool = 0;
  machine::Axis tool_axis = machine::Axis::Z;
  double tool_length = 0;  ///< mm
  double tool_radius = 0;
  std::vector<interpreter::RunMessage> errors{};
  /// Written until now; null as long as nobody has asked for them.
  std::shared_ptr<const std::vector<interpreter::WrittenFile>> files{};
};

/// What a reader asks a run for.
enum class Look : std::uint8_t { Nothing, State, StateAndFiles };

}  // namespace fitgauge::app
