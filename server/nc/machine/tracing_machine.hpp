#pragma once

#include "nc/machine/machine.hpp"

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

struct TraceOptions {
  std::function<void(const TracedMove&)> keep;  ///< receives each move at its end
  std::size_t longest = 1'000'000;              ///< maximum numbers of moves and of lines
  bool lines = false;                           ///< whether each command also writes a line of text
};

/// A decorator that records its commands: the moves of a run and, for golden tests, one line of
/// text for each command. A probing move is followed by the rapid of its way back; a move that ends
/// at a fault is recorded up to the fault. Owns the lines, not the machine. Not thread-safe.
class TracingMachine final : public Machine {
 public:
  TracingMachine(Machine& inner, TraceOptions options);

  const std::vector<std::string>& lines() const { return lines_; }
  /// Moves that came after the longest trace was full.
  std::size_t dropped() const { return dropped_; }

  const MachineState& state() const override { return inner_.state(); }
  std::optional<Vec3> contact_normal() const override { return inner_.contact_normal(); }
  std::vector<PartFeature> part_features(const Vec3& at) const override {
    return inner_.part_features(at);
  }
  bool has_entered_part() const override { return inner_.has_entered_part(); }
  MachineResult<void> move(const LinearMove& move) override;
  MachineResult<void> move_arc(const ArcMove& arc) override;
  MachineResult<ContactPoint> probe(const ProbeMove& move) override;
  MachineResult<void> call_tool(const ToolCall& call) override;
  MachineResult<void> write_tool(const Tool& tool) override;
  MachineResult<void> write_probe(const ProbeRow& row) override;
  MachineResult<void> write_preset(const Preset& preset) override;
  MachineResult<void> write_tool_touch_probe(const ToolTouchProbe& tt) override;
  MachineResult<void> activate_preset(int number) override;
  MachineResult<void> set_frames(const Frames& frames) override;
  MachineResult<void> set_modes(const Modes& modes) override;
  MachineResult<void> set_kinematics(const Kinematics& kinematics) override;
  MachineResult<void> dwell(double seconds) override;
  void stop(std::string_view reason) override;
  void message(std::string_view text) override;

 private:
  /// A move in progress: its start.
  struct Begun {
    Position start;
    Vec3 machine_start;
    double elapsed_s;
  };

  Begun begin() const { return {state().position(), machine_tip(), state().elapsed_s}; }
  Vec3 machine_tip() const { return state().position(CoordinateSystem::Machine).linear; }
  TracedArc traced(const ArcMove& arc, const Begun& begun) const;
  void keep(MoveKind kind, const Begun& begun, const Feed& feed,
            const std::optional<TracedArc>& arc = std::nullopt);
  void keep_probing(const Begun& begun, const ProbeMove& move,
                    const MachineResult<ContactPoint>& result);
  void add(const TracedMove& move);
  bool is_full() const { return kept_ >= options_.longest; }
  /// Writes the line that `text()` makes, with the fault if there is one. @returns the result
  template <class T, class Text>
  MachineResult<T> write(MachineResult<T> result, const Text& text);

  Machine& inner_;
  TraceOptions options_;
  std::vector<std::string> lines_;
  std::size_t kept_ = 0;  ///< moves
  std::size_t dropped_ = 0;
};

}  // namespace fitgauge::machine
