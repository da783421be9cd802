#pragma once

#include "nc/machine/machine.hpp"

namespace fitgauge::machine {

/// The result of a probing move of a log.
struct ScriptedContact {
  std::optional<Vec3> ball_centre;  ///< in mm; nothing: the move ended without contact
  CoordinateSystem system = CoordinateSystem::Input;
};

/// Replays the contacts of a real machine: every probing move uses the next one of a list. Its
/// table is empty, so other moves touch nothing. Not thread-safe.
class ScriptedAxes final : public Axes {
 public:
  /// A recorded contact may be `tolerance` mm away from the probing line.
  ScriptedAxes(const Position& start, std::vector<ScriptedContact> contacts, double tolerance)
      : nose_(start), contacts_(std::move(contacts)), tolerance_(tolerance) {}

  /// Recorded contacts are written in the coordinates of the control that replays them.
  /// @param control outlives the axes' use
  void serve(const MachineState& control) { control_ = &control; }
  std::size_t remaining() const { return contacts_.size() - next_; }

  Position nose() const override { return nose_; }
  MachineResult<double> follow(const Path& path, const Motion& motion) override {
    if (motion.allowance.found() != Allowance::Spent::Nothing)
      return make_fault(FaultKind::Interrupted);
    nose_ = path.end;
    return 1;
  }
  /// @faults ScriptExhausted; ScriptedDifferent when the recorded contact is not on this line.
  MachineResult<Position> probe(const Vec3& direction, double distance,
                                const Motion& motion) override {
    if (motion.allowance.found() != Allowance::Spent::Nothing)
      return make_fault(FaultKind::Interrupted);
    if (next_ == contacts_.size())
      return make_fault(FaultKind::ScriptExhausted, "all {} are used", next_);
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
  MachineResult<void> dwell(double, Allowance&) override { return {}; }
  void stop(std::string_view) override {}

 private:
  Position nose_;
  std::vector<ScriptedContact> contacts_;
  double tolerance_;
  std::size_t next_ = 0;
  const MachineState* control_ = nullptr;
};

/// A control over axes that replay a log. Not thread-safe.
class ScriptedMachine final : public Machine {
 public:
  /// @param allowance as of Machine
  /// @pre validate() accepts the setup that `setup` is part of.
  ScriptedMachine(const MachineSetup& setup, std::vector<ScriptedContact> contacts,
                  Allowance* allowance = nullptr, double tolerance = 0.05)
      : ScriptedMachine(setup,
                        new ScriptedAxes(setup.start_position(), std::move(contacts), tolerance),
                        allowance) {}

  std::size_t remaining() const { return axes_.remaining(); }

 private:
  /// Owns `axes`.
  ScriptedMachine(const MachineSetup& setup, ScriptedAxes* axes, Allowance* allowance)
      : Machine(setup, std::unique_ptr<Axes>(axes), allowance), axes_(*axes) {
    axes_.serve(state());
  }

  ScriptedAxes& axes_;
};

}  // namespace fitgauge::machine
