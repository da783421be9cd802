#pragma once

#include <array>

#include "machine/modelled_machine.hpp"
#include "machine/random.hpp"
#include "machine/workpiece.hpp"

namespace fitgauge::machine {

/// A machine that exists in a setup alone: its real axes, tools and probe may differ from what the
/// control's tables say, and a workpiece stands on its table. The ball of the touch probe is what
/// touches; stylus and holder are not modelled, and cutters pass through material.
/// The same setup and the same commands give the same run. Not thread-safe.
class SimulatedMachine final : public ModelledMachine {
 public:
  /// @param allowance as of ModelledMachine
  /// @pre validate(setup) succeeds.
  explicit SimulatedMachine(const Setup& setup, Allowance* allowance = nullptr);

  std::optional<Vec3> contact_normal() const override;

 private:
  /// The tool in the spindle as it really is.
  struct RealTool {
    double length;
    double radius;
    Vec3 offset;              ///< of the ball centre from the spindle axis
    const ProbeSetup* probe;  ///< null: a cutter, or a probe that the setup does not describe
  };

  void on_turn(const Vec3& rotary) override;
  double free_part(const Path& path) override;
  MachineResult<double> contact(const Vec3& direction, double distance) override;

  RealTool real_tool() const;
  Transform real_table(const Vec3& rotary) const;
  Vec3 real_tool_point(const Position& nose, double length) const;
  Vec3 ball_on_table(const Position& nose, const RealTool& tool) const;
  MachineResult<double> probe_contact(const Vec3& direction, double distance, const RealTool& tool);
  MachineResult<double> plate_contact(const Vec3& direction, double distance, const RealTool& tool);

  MachineSetup setup_;
  Workpiece workpiece_;
  Kinematics kinematics_;  ///< as built, with the errors of centre and direction
  Vec3 slack_deg_;         ///< what backlash adds to the positions of A, B, C at present
  Displacements rest_;     ///< what the scatter of the axes adds at present
  Random random_;
  std::optional<Vec3> touching_;  ///< centre of the ball at the last contact, on the table
  Transform table_at_contact_;
};

}  // namespace fitgauge::machine
