#pragma once

#include "nc/machine/axes.hpp"
#include "nc/machine/machine_setup.hpp"

namespace fitgauge::machine {

/// A straight move of all named axes together; axes without a word keep their coordinate in
/// `system`. Rotary words need no linear ones: the linear axes stay, or follow with TCPM.
struct LinearMove {
  AxisWords target;
  Feed feed;
  CoordinateSystem system = CoordinateSystem::Input;
};

/// An arc or helix in the plane across `normal`, in input coordinates. The end is met exactly; the
/// radius and the height change evenly on the way.
struct ArcMove {
  Vec3 end;               ///< in mm
  Vec3 centre;            ///< in mm; its coordinate along `normal` does not matter
  double sweep_deg = 0;   ///< positive counter-clockwise seen from +`normal` (DR+); may exceed 360
  Axis normal = Axis::Z;  ///< X, Y or Z
  Feed feed;
};

/// A probing move from the current position until contact, then back.
struct ProbeMove {
  Vec3 direction;   ///< of the travel; any length but 0
  double distance;  ///< longest travel, in mm of the machine (DIST, ABST); positive
  double feed;      ///< in mm/min (F of tchprobe.tp)
  CoordinateSystem system = CoordinateSystem::Input;  ///< that `direction` is given in
  /// After contact, back by that many mm (MB), at most to the start; without: there.
  std::optional<double> retract{};
  Feed retract_feed;
};

/// Result of a contact. The control computes the points from its scales, the effective length and
/// radius and CAL_OF. They are input coordinates at the moment of contact unless named otherwise.
struct ContactPoint {
  Vec3 tip;            ///< the ball's south pole (a cutter's tip on the tool touch probe)
  Vec3 ball_centre;    ///< circles and spheres are fitted through these
  Vec3 surface;        ///< ball centre moved by the effective radius along the probing direction
  Vec3 tip_machine;    ///< `tip` in Machine coordinates
  Position nose;       ///< Reference: neither length nor radius compensated (Q115 to Q119)
  double seconds = 0;  ///< of the travel to the contact
};

/// TOOL CALL. Without a number only the named values change; with one, oversizes that are not named
/// are 0.
struct ToolCall {
  std::optional<int> number;  ///< 0 empties the spindle
  std::optional<Axis> axis;
  std::optional<double> spindle_rpm;
  std::optional<double> dl{};  ///< mm
  std::optional<double> dr{};
  std::optional<double> dr2{};
};

enum class MoveKind : std::uint8_t { Rapid, Feed, Probe, Arc };

/// "rapid", "feed", "probe", "arc".
std::string_view name(MoveKind kind);

/// Data of an arc except its ends, for the machine's forms without an additional scaling factor.
struct TracedArc {
  Vec3 centre;          ///< in input coordinates, at the height of the start
  double sweep_deg;     ///< as programmed; positive counter-clockwise seen from the axis' tip
  Axis axis = Axis::Z;  ///< of the input coordinates, across the arc's plane
  Vec3 machine_centre{};
  Vec3 machine_axis{};  ///< unit vector
};

/// The contact of a probing move.
struct TracedContact {
  Vec3 surface;  ///< the point of the surface, in input coordinates
  Vec3 machine_surface;
  std::optional<Vec3> normal;  ///< away from the material, in Machine coordinates, if it is known
};

/// One move of the trace: of the tool tip, in input and in machine coordinates.
struct TracedMove {
  MoveKind kind = MoveKind::Rapid;
  Position start;
  Position end;
  double feed_mm_min = 0;  ///< of a rapid the rate it is limited to
  double seconds = 0;
  Vec3 machine_start;  ///< Machine coordinates: a preset or a rotation does not break the line
  Vec3 machine_end;
  std::optional<TracedArc> arc{};
  std::optional<TracedContact> contact{};
};

/// A machine tool as NC programs see it: the control above its axes. It has tables, frames, modes,
/// tool calls, targets of moves, axis ranges and machining time; the axes report contacts on the
/// way. Its files are the tables, frames and probing (machine.cpp), the motion, and the trace.
/// Lengths in mm, angles in degrees, feeds in mm/min, times in seconds; directions as ISO 841 (the
/// tool moves, +Z away from the workpiece). A command is executed completely or returns the fault;
/// after a fault the machine stops where it is, its state contains the finished part of the
/// command, and it accepts commands again. Not thread-safe; one run owns a machine.
class Machine {
 public:
  /// @param allowance ends a move when it stops; null: nothing interrupts moves
  /// @pre validate() accepts the setup that `setup` is part of; `allowance` outlives the machine
  Machine(const MachineSetup& setup, std::unique_ptr<Axes> axes, Allowance* allowance = nullptr);
  virtual ~Machine() = default;

  /// Calls `keep` with each move at its end, at most `longest` times. A probing move is followed by
  /// the rapid of its way back; a move that ends at a fault is recorded up to the fault.
  void trace(std::function<void(const TracedMove&)> keep, std::size_t longest);
  /// Moves that came after the longest trace was full.
  std::size_t untraced() const { return untraced_; }

  /// All that can be read; the reference stays valid and follows every command.
  const MachineState& state() const { return state_; }

  Position position(CoordinateSystem system = CoordinateSystem::Input) const {
    return state_.position(system);
  }

  /// @faults AxisLimit and AxisMissing (nothing has moved), HirthGrid, FeedMissing, ValueInvalid;
  /// Collision (stops at the contact).
  virtual MachineResult<void> move(const LinearMove& move);

  /// @faults as move.
  virtual MachineResult<void> move_arc(const ArcMove& arc);

  /// Normal of the surface at the last contact, away from the material, in Machine coordinates;
  /// none if the machine does not know it, like a real one.
  std::optional<Vec3> contact_normal() const { return axes_->contact_normal(); }

  /// The bores, pockets and bosses of the part that have a point in input coordinates near their
  /// axis; none if the machine does not know them, like a real one.
  std::vector<PartFeature> part_features(const Vec3& at) const {
    return axes_->part_features(state_.frames.to_machine(at));
  }

  /// Returns whether a cutter has entered the part in the last motion, which was in rapid; false if
  /// the machine does not know the part.
  bool has_entered_part() const { return axes_->has_entered_part(); }

  /// Moves a touch probe towards the workpiece, or another tool towards the tool touch probe TT.
  /// @faults ToolAxisMissing, NoTool, FeedMissing, ValueInvalid (nothing has moved);
  /// StylusDeflected (touches at the start); NoContact (at the end of the travel); AxisLimit (at
  /// the limit, without contact); Collision (on the way back beyond the start).
  virtual MachineResult<ContactPoint> probe(const ProbeMove& move);

  /// Changes the tool in place: the nose does not move.
  /// @faults ToolUnknown, ToolLocked, ToolAxisMissing (no axis now or before).
  virtual MachineResult<void> call_tool(const ToolCall& call);

  /// Writes a row of tool.t, tchprobe.tp or preset.pr, new or replaced, or the data of the TT. A
  /// tool or probe in the spindle changes at once (the nose stays), the active preset with the next
  /// activation. @faults PresetLocked, ValueInvalid.
  virtual MachineResult<void> write_tool(const Tool& tool);
  virtual MachineResult<void> write_probe(const ProbeRow& row);
  virtual MachineResult<void> write_preset(const Preset& preset);
  virtual MachineResult<void> write_tool_touch_probe(const ToolTouchProbe& tt);

  /// Cycle 247: the row becomes active and datum shift, mirror, rotation and scaling are reset.
  /// @faults PresetUnknown.
  virtual MachineResult<void> activate_preset(int number);

  /// Replaces the chain of frames: datum shift, mirror, rotation, scaling, tilted plane, and what
  /// of the active preset a cycle overrides (its basic rotation). The table's part stays the
  /// machine's.
  /// @faults ValueInvalid (not finite, or a scaling factor of 0).
  virtual MachineResult<void> set_frames(const Frames& frames);

  /// Spindle, its orientation, coolant, feed, TCPM and operating mode. @faults ValueInvalid,
  ///   OptionMissing (TCPM).
  virtual MachineResult<void> set_modes(const Modes& modes);

  /// Replaces the control's kinematic model (cycles 450 to 452). @faults AxisMissing, ValueInvalid.
  virtual MachineResult<void> set_kinematics(const Kinematics& kinematics);

  /// Waits without motion. @faults ValueInvalid (negative).
  virtual MachineResult<void> dwell(double seconds);

  /// A programmed stop (STOP, M0, M1): the machine waits for NC Start.
  virtual void stop(std::string_view reason) { axes_->stop(reason); }

 private:
  /// A traced move in progress: its start.
  struct Begun {
    Position start;
    Vec3 machine_start;
    double elapsed_s;
  };

  MachineResult<void> move_straight(const LinearMove& move);
  MachineResult<void> move_around(const ArcMove& arc);
  MachineResult<ContactPoint> touch(const ProbeMove& move);
  std::optional<Begun> begin() const;
  Vec3 machine_tip() const { return state_.position(CoordinateSystem::Machine).linear; }
  TracedArc traced(const ArcMove& arc, const Begun& begun) const;
  void add(const TracedMove& move);
  void keep(MoveKind kind, const Begun& begun, const Feed& feed,
            const std::optional<TracedArc>& arc = std::nullopt);
  void keep_probing(const Begun& begun, const ProbeMove& move,
                    const MachineResult<ContactPoint>& contact);
  static MachineResult<void> check_feed(const Feed& feed);
  double seconds_of(double way, const Feed& feed) const;
  void spend(double seconds);
  Motion motion(const Feed& feed, bool is_retract = false);
  MachineResult<double> follow(const Path& path, const Motion& motion);
  MachineResult<double> follow_pieces(const Path& path, const Motion& motion, double from,
                                      double to);
  MachineResult<void> travel(const Path& path, const Feed& feed, bool is_retract = false);
  MachineResult<Position> target_nose(const LinearMove& move, const Frames& frames,
                                      const Vec3& rotary) const;
  MachineResult<Vec3> target_rotary(const LinearMove& move) const;
  Path following_path(const Position& end) const;
  MachineResult<void> check_way(const Path& path, double turn_deg);
  MachineResult<void> check_range(const Position& nose) const;
  MachineResult<void> go_back(const Position& start, const Vec3& direction, const ProbeMove& move);
  double reach(const Vec3& direction, double distance) const;
  void stand_at(const Position& nose);
  bool is_following() const { return state_.modes.tcpm || state_.frames.is_tilted(); }
  void refresh_table();
  ContactPoint contact_point(const Vec3& direction) const;

  std::unique_ptr<Axes> axes_;
  MachineState state_;
  Allowance unlimited_;
  Allowance& allowance_;
  std::function<void(const TracedMove&)> keep_;
  std::size_t left_ = 0;  ///< moves that the trace can still take
  std::size_t untraced_ = 0;
};

}  // namespace fitgauge::machine
