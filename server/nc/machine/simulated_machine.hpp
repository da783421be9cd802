#pragma once

#include "nc/machine/machine.hpp"
#include "nc/machine/random.hpp"
#include "nc/machine/workpiece.hpp"

namespace fitgauge::machine {

/// Axes of a setup: they, their tools and their probe may differ from the control's tables, and a
/// workpiece is on their table. Only the ball of the touch probe touches; stylus and holder are not
/// modelled, and cutters pass through material: only entering it in rapid or not turning is known.
/// Fixtures collide with every tool, modelled as a ball of its radius at the tip. The same setup
/// and the same commands give the same run. Not thread-safe.
class SimulatedAxes final : public Axes {
 public:
  /// @pre validate(setup) succeeds.
  explicit SimulatedAxes(const Setup& setup);

  Position nose() const override { return nose_; }
  MachineResult<double> follow(const Path& path, const Motion& motion) override;
  MachineResult<Position> probe(const Vec3& direction, double distance,
                                const Motion& motion) override;
  std::optional<Vec3> contact_normal() const override;
  std::vector<PartFeature> part_features(const Vec3& at) const override;
  bool has_entered_part() const override { return has_entered_part_; }
  MachineResult<void> dwell(double, Allowance&) override { return {}; }
  void stop(std::string_view) override {}

 private:
  /// The tool in the spindle as it really is.
  struct RealTool {
    Axis axis;
    double length;
    double radius;
    Vec3 offset;              ///< of the ball centre from the spindle axis
    const ProbeSetup* probe;  ///< null: a cutter, or a probe that the setup does not describe
    bool is_lathe;            ///< the ball is the round of its cutting edge, of radius RS
  };

  void turn(const Vec3& rotary);
  bool starts_free(const Path& path, const SpindleTool& known) const;
  bool goes_on(const Path& path, const Motion& motion) const;
  double free_part(const Workpiece& body, const Path& path, const RealTool& tool,
                   Allowance& allowance) const;
  RealTool real_tool(const SpindleTool& known) const;
  Transform real_table(const Vec3& rotary) const;
  Vec3 real_tool_point(const Position& nose, const RealTool& tool, double length) const;
  Vec3 ball_on_table(const Position& nose, const RealTool& tool) const;
  MachineResult<double> probe_contact(const Vec3& direction, double distance, const RealTool& tool,
                                      Allowance& allowance);
  MachineResult<double> plate_contact(const Vec3& direction, double distance, const RealTool& tool,
                                      Allowance& allowance);

  MachineResult<double> triggered(double way, double repeatability_um, double distance);
  std::optional<PartFeature> rectangle_at(const Vec3& place) const;

  /// A bore or boss of the part, and its centre.
  struct RoundPlace {
    std::array<double, 2> centre;
    PartFeature feature;
  };

  MachineSetup setup_;
  std::vector<RoundPlace> round_;
  std::vector<Block> blocks_;
  Workpiece workpiece_;
  Workpiece fixtures_;
  Kinematics kinematics_;  ///< as built, with the errors of centre and direction
  Position nose_;
  Vec3 slack_deg_;      ///< present backlash in the positions of A, B, C
  Displacements rest_;  ///< the current scatter of the axes
  Random random_;
  bool has_entered_part_ = false;
  std::optional<Vec3> touching_;  ///< centre of the ball at the last contact, on the table
  Transform table_at_contact_;
};

/// A control with the axes of a setup. Not thread-safe.
class SimulatedMachine : public Machine {
 public:
  /// @param allowance as of Machine
  /// @pre validate(setup) succeeds.
  explicit SimulatedMachine(const Setup& setup, Allowance* allowance = nullptr)
      : Machine(setup.machine, std::make_unique<SimulatedAxes>(setup), allowance) {}
};

}  // namespace fitgauge::machine
