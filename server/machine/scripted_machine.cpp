#include "machine/scripted_machine.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::machine {

ScriptedMachine::ScriptedMachine(const MachineSetup& setup, std::vector<ScriptedContact> contacts,
                                 Allowance* allowance, double tolerance)
    : ModelledMachine(setup, allowance), contacts_(std::move(contacts)), tolerance_(tolerance) {}

MachineResult<double> ScriptedMachine::contact(const Vec3& direction, double distance) {
  if (next_ == contacts_.size()) {
    return make_fault(FaultKind::ScriptExhausted, fmt::format("all {} are used", next_));
  }
  const ScriptedContact& recorded = contacts_[next_++];
  if (!recorded.ball_centre) return make_fault(FaultKind::NoContact);
  const Vec3 found = state().frames.to_machine(*recorded.ball_centre, recorded.system);
  const Vec3 way = found - state().ball_centre(CoordinateSystem::Machine);
  const double along = dot(way, direction);
  const double beside = norm(way - direction * along);
  if (beside > tolerance_ || along < -tolerance_ || along > distance + tolerance_) {
    return make_fault(FaultKind::ScriptedDifferent,
                      fmt::format("contact {} lies {:.4f} mm along the probing line and {:.4f} mm "
                                  "beside it",
                                  next_, along, beside));
  }
  return std::clamp(along, 0.0, distance);
}

}  // namespace fitgauge::machine
