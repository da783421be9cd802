#include "nc/machine/scripted_machine.hpp"

namespace fitgauge::machine {

MachineResult<double> ScriptedAxes::follow(const Path& path, const Motion& motion) {
  if (motion.allowance.found() != Allowance::Spent::Nothing) {
    return make_fault(FaultKind::Interrupted);
  }
  nose_ = path.end;
  return 1;
}

MachineResult<Position> ScriptedAxes::probe(const Vec3& direction, double distance,
                                            const Motion& motion) {
  if (motion.allowance.found() != Allowance::Spent::Nothing) {
    return make_fault(FaultKind::Interrupted);
  }
  if (next_ == contacts_.size()) {
    return make_fault(FaultKind::ScriptExhausted, "all {} are used", next_);
  }
  const ScriptedContact& recorded = contacts_[next_++];
  if (!recorded.ball_centre) {
    nose_.linear = nose_.linear + direction * distance;
    return make_fault(FaultKind::NoContact);
  }
  const Vec3 found = control_->frames.to_machine(*recorded.ball_centre, recorded.system);
  const Vec3 way = found - control_->ball_centre(CoordinateSystem::Machine);
  const double along = dot(way, direction);
  const double beside = norm(way - direction * along);
  if (beside > tolerance_ || along < -tolerance_ || along > distance + tolerance_) {
    return make_fault(FaultKind::ScriptedDifferent,
                      "contact {} lies {:.4f} mm along the probing line and {:.4f} mm "
                      "beside it",
                      next_, along, beside);
  }
  nose_.linear = nose_.linear + direction * std::clamp(along, 0.0, distance);
  return nose_;
}

}  // namespace fitgauge::machine
