#pragma once

namespace fitgauge::machine {

enum class FaultKind : std::uint8_t {
  NoContact,          ///< 1014: nothing touched within the probing distance
  StylusDeflected,    ///< the stylus touches before the probing move begins
  Collision,          ///< the probe touched outside a probing move
  FixtureCollision,   ///< a tool touched a fixture
  AxisLimit,          ///< the spindle nose or a rotary axis would leave its range
  AxisMissing,        ///< the machine has no such axis
  HirthGrid,          ///< a rotary axis with a Hirth grid would stop between two teeth
  ToolAxisMissing,    ///< 1001: no TOOL CALL has defined the tool axis
  NoTool,             ///< 1092: the command needs a tool in the spindle
  ToolUnknown,        ///< 1092: the tool table has no such tool
  ToolLocked,         ///< the tool table marks the tool as locked (TL = L)
  NotAProbe,          ///< 1093: a probing cycle needs a touch probe in the spindle
  OptionMissing,      ///< 1095: the machine does not have this software option
  FeedMissing,        ///< 1010: a feed move with a feed that is not positive
  PresetUnknown,      ///< the preset table has no such row
  PresetLocked,       ///< 1085: the row of the preset table is write-protected
  ValueInvalid,       ///< 1011: a coordinate, direction or time is not a finite number in range
  Interrupted,        ///< the allowance of the run is spent, or the run was called off
  EmergencyStop,      ///< the machine was stopped by its emergency stop
  FeedHold,           ///< the feed was on hold for longer than the driver waits
  Aborted,            ///< the operator has aborted the motion
  ConnectionLost,     ///< the position of the machine is unknown
  ScriptExhausted,    ///< a scripted machine has no contact left
  ScriptedDifferent,  ///< a scripted machine met a command its log does not have
};

/// Reason why the machine could not execute a command. A value of the run, never an exception. The
/// enum class stays first: see fitgauge::Error.
struct MachineFault {
  FaultKind kind{};
  int number = 0;    ///< the control's error number (1001 to 1199), 0 if it shows only text
  std::string text;  ///< the control's text, then the event and its place in mm

  friend bool operator==(const MachineFault&, const MachineFault&) = default;
};

/// The number and the control's text of a kind: 1014 "Touch point inaccessible".
MachineFault make_fault(FaultKind kind, std::string_view detail = {});

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
