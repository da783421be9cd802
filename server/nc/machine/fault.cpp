#include "nc/machine/fault.hpp"

namespace fitgauge::machine {
namespace {

struct FaultText {
  int number;
  std::string_view text;
};

FaultText text_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::NoContact: return {1014, "Touch point inaccessible"};
    case FaultKind::StylusDeflected: return {0, "Stylus already deflected"};
    case FaultKind::Collision: return {0, "Touch probe collision"};
    case FaultKind::FixtureCollision: return {0, "Collision with a fixture"};
    case FaultKind::AxisLimit: return {0, "Limit switch"};
    case FaultKind::AxisMissing: return {0, "Axis not available"};
    case FaultKind::HirthGrid: return {0, "Position is not on the Hirth grid"};
    case FaultKind::ToolAxisMissing: return {1001, "Tool axis is missing"};
    case FaultKind::NoTool:
    case FaultKind::ToolUnknown: return {1092, "Tool not defined"};
    case FaultKind::ToolLocked: return {0, "Tool locked"};
    case FaultKind::NotAProbe: return {1093, "Tool number not permitted"};
    case FaultKind::OptionMissing: return {1095, "Software option not active"};
    case FaultKind::FeedMissing: return {1010, "Feed rate is missing"};
    case FaultKind::PresetUnknown: return {0, "Preset not found"};
    case FaultKind::PresetLocked: return {1085, "Line is write-protected"};
    case FaultKind::ValueInvalid: return {1011, "Input value incorrect"};
    case FaultKind::Interrupted: return {0, "Program run interrupted"};
    case FaultKind::EmergencyStop: return {0, "Emergency stop"};
    case FaultKind::FeedHold: return {0, "Feed hold"};
    case FaultKind::Aborted: return {0, "Motion aborted by the operator"};
    case FaultKind::ConnectionLost: return {0, "Connection to the machine lost"};
    case FaultKind::ScriptExhausted: return {0, "No recorded contact is left"};
    case FaultKind::ScriptedDifferent: return {0, "Command differs from the recorded one"};
  }
  return {0, "Machine fault"};
}

}  // namespace

MachineFault make_fault(FaultKind kind, std::string_view detail) {
  const FaultText known = text_of(kind);
  std::string text(known.text);
  if (!detail.empty()) text += fmt::format(": {}", detail);
  return {kind, known.number, std::move(text)};
}

void throw_bad_machine_result(const MachineFault& fault) {
  throw std::logic_error(fmt::format("value of a failed machine command was read: {}", fault.text));
}

}  // namespace fitgauge::machine
