#pragma once

#include "base/allowance.hpp"
#include "machine/machine.hpp"
#include "machine/machine_setup.hpp"
#include "machine/path.hpp"

namespace fitgauge::machine {

/// The control's half of a machine without hardware: tables, frames, modes, tool calls, where a
/// move leads, axis ranges, machining time. What a move meets on its way is the derived class's.
/// Its three files are the tables and frames, the motion, and the probing.
/// Owns its state. Not thread-safe; after a fault the state is what the finished part has made it.
class ModelledMachine : public Machine {
 public:
  const MachineState& state() const final { return state_; }
  MachineResult<void> move(const LinearMove& move) final;
  MachineResult<void> move_arc(const ArcMove& arc) final;
  MachineResult<ContactPoint> probe(const ProbeMove& move) final;
  MachineResult<void> call_tool(const ToolCall& call) final;
  MachineResult<void> write_tool(const Tool& tool) final;
  MachineResult<void> write_probe(const ProbeRow& row) final;
  MachineResult<void> write_preset(const Preset& preset) final;
  MachineResult<void> write_tool_touch_probe(const ToolTouchProbe& tt) final;
  MachineResult<void> activate_preset(int number) final;
  MachineResult<void> set_frames(const Frames& frames) final;
  MachineResult<void> set_modes(const Modes& modes) final;
  MachineResult<void> set_kinematics(const Kinematics& kinematics) final;
  MachineResult<void> dwell(double seconds) final;
  void stop(std::string_view reason) override;
  void message(std::string_view text) override;

 protected:
  /// @param allowance what its moves look at while they last; null: nothing interrupts them
  /// @pre validate() accepts the setup that `setup` is part of; `allowance` outlives the machine
  ModelledMachine(const MachineSetup& setup, Allowance* allowance);
  Allowance& allowance() { return allowance_; }

  /// The rotary axes are about to turn to `rotary`.
  virtual void on_turn(const Vec3& rotary) = 0;
  /// The part of the path, 0 to 1, that the tool can go without a collision.
  virtual double free_part(const Path& path) = 0;
  /// How far the machine travels along the unit vector `direction` (machine coordinates) until the
  /// control sees the contact, in mm, at most `distance`.
  /// @faults NoContact, StylusDeflected, those of a script.
  virtual MachineResult<double> contact(const Vec3& direction, double distance) = 0;

 private:
  static MachineResult<void> check_feed(const Feed& feed);
  double seconds_of(double way, const Feed& feed) const;
  void spend(double seconds);
  MachineResult<void> travel(const Path& path, const Feed& feed);
  MachineResult<Position> target_nose(const LinearMove& move, const Frames& frames,
                                      const Vec3& rotary) const;
  MachineResult<Vec3> target_rotary(const LinearMove& move) const;
  Path following_path(const Position& end) const;
  MachineResult<void> check_way(const Path& path, double turn_deg);
  MachineResult<void> check_range(const Position& nose) const;
  MachineResult<void> go_back(const Vec3& direction, double way, const ProbeMove& move);
  double reach(const Vec3& direction, double distance) const;
  void stand_at(const Position& nose);
  void advance(const Vec3& way) { state_.nose.linear = state_.nose.linear + way; }
  bool is_following() const { return state_.modes.tcpm || state_.frames.is_tilted(); }
  Transform table_at(const Vec3& rotary) const;
  void refresh_table();
  ContactPoint contact_point(const Vec3& direction) const;

  MachineState state_;
  Allowance unlimited_;
  Allowance& allowance_;
};

}  // namespace fitgauge::machine
