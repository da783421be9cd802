#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/machine.hpp"

namespace fitgauge::machine {

enum class MoveKind : std::uint8_t { Rapid, Feed, Probe, Arc };

/// "rapid", "feed", "probe", "arc".
std::string_view name(MoveKind kind);

/// One move of the trace: of the tool tip, in input coordinates.
struct TracedMove {
  MoveKind kind = MoveKind::Rapid;
  std::int64_t block = 0;
  Position start;
  Position end;
  double feed_mm_min = 0;  ///< of a rapid the rate it is limited to
  double seconds = 0;
  std::optional<Vec3> contact;  ///< of a probing move: the touched point of the surface
};

struct TraceOptions {
  std::function<std::int64_t()> block;  ///< number of the block being executed; without it 0
  std::size_t longest = 1'000'000;      ///< moves, and lines, that are kept
  bool lines = false;                   ///< whether each command also writes a line of text
};

/// A decorator that keeps what passes through it: the moves of a run and, for golden tests, one
/// line of text for each command. A probing move is followed by the rapid of its way back; a move
/// that ends at a fault is kept as far as it went. Owns the trace, not the machine. Not
/// thread-safe.
class TracingMachine final : public Machine {
 public:
  TracingMachine(Machine& inner, TraceOptions options);

  const std::vector<TracedMove>& moves() const { return moves_; }
  const std::vector<std::string>& lines() const { return lines_; }
  /// Moves that came after the longest trace was full.
  std::size_t dropped() const { return dropped_; }

  const MachineState& state() const override { return inner_.state(); }
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
  /// A move that is under way: what it started from.
  struct Begun {
    Position start;
    double elapsed_s;
  };

  Begun begin() const { return {state().position(), state().elapsed_s}; }
  void keep(MoveKind kind, const Begun& begun, const Feed& feed);
  void keep_probing(const Begun& begun, const ProbeMove& move,
                    const MachineResult<ContactPoint>& result);
  void add(TracedMove move);
  /// Writes the line that `text()` makes, with the fault when there is one.
  template <class T, class Text>
  void write(const MachineResult<T>& result, const Text& text);

  Machine& inner_;
  TraceOptions options_;
  std::vector<TracedMove> moves_;
  std::vector<std::string> lines_;
  std::size_t dropped_ = 0;
};

}  // namespace fitgauge::machine
