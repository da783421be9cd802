#pragma once

#include "nc/machine/axes.hpp"
#include "nc/machine/machine.hpp"
#include "nc/machine/machine_setup.hpp"

namespace fitgauge::machine {

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

/// The control above the axes: tables, frames, modes, tool calls, targets of moves, axis ranges,
/// machining time. The axes report contacts on the way. Its files are the tables, frames and
/// probing, the motion, and the trace. Owns its state and its axes. Not thread-safe. After a fault,
/// the state contains the finished part of the command.
class Control : public Machine {
 public:
  /// @param allowance ends a move when it stops; null: nothing interrupts moves
  /// @pre validate() accepts the setup that `setup` is part of; `allowance` outlives the machine
  Control(const MachineSetup& setup, std::unique_ptr<Axes> axes, Allowance* allowance = nullptr);

  /// Calls `keep` with each move at its end, at most `longest` times. A probing move is followed by
  /// the rapid of its way back; a move that ends at a fault is recorded up to the fault.
  void trace(std::function<void(const TracedMove&)> keep, std::size_t longest);
  /// Moves that came after the longest trace was full.
  std::size_t untraced() const { return untraced_; }

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
  void stop(std::string_view reason) final { axes_->stop(reason); }
  void message(std::string_view text) final { axes_->message(text); }
  std::optional<Vec3> contact_normal() const final { return axes_->contact_normal(); }
  std::vector<PartFeature> part_features(const Vec3& at) const final {
    return axes_->part_features(state_.frames.to_machine(at));
  }
  bool has_entered_part() const final { return axes_->has_entered_part(); }

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
