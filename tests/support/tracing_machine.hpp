#pragma once

#include "nc/machine/simulated_machine.hpp"

namespace fitgauge::machine {
namespace trace_text {

/// "+1.2500": to 0.1 um, and zero is never negative.
inline std::string number(double value) {
  constexpr double kHalfStep = 0.00005;
  return fmt::format("{:+.4f}", std::abs(value) < kHalfStep ? 0.0 : value);
}

/// "X+1.0000 Y-2.5000 Z+0.0000".
inline std::string text_of(const Vec3& p) {
  return fmt::format("X{} Y{} Z{}", number(p.x), number(p.y), number(p.z));
}

/// "PREFIXA+1.0000 PREFIXB+2.0000 PREFIXC+3.0000".
inline std::string angles(std::string_view prefix, const Vec3& a) {
  return fmt::format("{0}A{1} {0}B{2} {0}C{3}", prefix, number(a.x), number(a.y), number(a.z));
}

/// The linear axes, and the rotary ones that the machine has.
inline std::string text_of(const Position& position, const MachineState& state) {
  std::string text = text_of(position.linear);
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    if (!state.ranges[index(axis)]) continue;
    text += fmt::format(" {}{}", name(axis), number(position[axis]));
  }
  return text;
}

inline std::string text_of(const Feed& feed) {
  if (!feed.is_rapid) return fmt::format("F{:g}", feed.rate);
  return std::isfinite(feed.rate) ? fmt::format("FMAX {:g}", feed.rate) : "FMAX";
}

inline std::string text_of(const Frames& frames) {
  std::string text = "FRAMES " + text_of(frames.datum_shift().linear);
  const Vec3& basic = frames.preset().basic_rotation_deg;
  if (basic != Vec3{}) text += " " + angles("SP", basic);
  if (frames.is_tilted()) text += " PLANE " + angles("", frames.plane()->spatial_deg);
  if (frames.is_mirrored()) {
    text += " MIRROR ";
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
      if (frames.mirror()[index(axis)]) text += name(axis);
    }
  }
  if (frames.is_rotated()) text += fmt::format(" ROT{:+.4f}", frames.rotation().angle_deg);
  if (frames.is_scaled()) {
    const Vec3& factor = frames.scaling().factor;
    text += fmt::format(" SCL {:g} {:g} {:g}", factor.x, factor.y, factor.z);
  }
  return text;
}

inline std::string text_of(const ToolCall& call) {
  std::string text = "TOOL CALL";
  if (call.number) text += fmt::format(" {}", *call.number);
  if (call.axis) text += fmt::format(" {}", name(*call.axis));
  if (call.spindle_rpm) text += fmt::format(" S{:g}", *call.spindle_rpm);
  return text + fmt::format(" DL{:+.4f} DR{:+.4f}", call.dl.value_or(0), call.dr.value_or(0));
}

}  // namespace trace_text

struct TraceOptions {
  std::function<void(const TracedMove&)> keep;  ///< receives each move at its end
  std::size_t longest = 1'000'000;              ///< maximum numbers of moves and of lines
  bool lines = false;                           ///< whether each command also writes a line of text
};

/// A simulated machine that records its commands: its moves and, for golden tests, one line of text
/// for each command. Not thread-safe.
class TracingMachine final : public SimulatedMachine {
 public:
  TracingMachine(const Setup& setup, TraceOptions options, Allowance* allowance = nullptr)
      : SimulatedMachine(setup, allowance), lines_most_(options.lines ? options.longest : 0) {
    trace(
        options.keep ? std::move(options.keep) : [](const TracedMove&) {}, options.longest);
  }

  const std::vector<std::string>& lines() const { return lines_; }
  std::size_t dropped() const { return untraced(); }

  MachineResult<void> move(const LinearMove& move) override {
    return write(SimulatedMachine::move(move), [&] {
      return fmt::format("L {} {}", text_of(state().position(), state()), text_of(move.feed));
    });
  }
  MachineResult<void> move_arc(const ArcMove& arc) override {
    return write(SimulatedMachine::move_arc(arc), [&] {
      return fmt::format("ARC {} CC {} {:+.4f} {}", text_of(state().position(), state()),
                         text_of(arc.centre), arc.sweep_deg, text_of(arc.feed));
    });
  }
  MachineResult<ContactPoint> probe(const ProbeMove& move) override {
    auto result = SimulatedMachine::probe(move);
    return write(result, [&] {
      return fmt::format("PROBE {} F{:g}{}", text_of(move.direction), move.feed,
                         result ? " TOUCHED " + text_of(result->surface) : std::string());
    });
  }
  MachineResult<void> call_tool(const ToolCall& call) override {
    return write(SimulatedMachine::call_tool(call), [&] { return text_of(call); });
  }
  MachineResult<void> write_tool(const Tool& tool) override {
    return write(SimulatedMachine::write_tool(tool), [&] {
      return fmt::format("TOOL {} L{:+.4f} R{:+.4f} DL{:+.4f} DR{:+.4f}{}", tool.number, tool.l,
                         tool.r, tool.dl, tool.dr, tool.locked ? " LOCKED" : "");
    });
  }
  MachineResult<void> write_probe(const ProbeRow& row) override {
    return write(SimulatedMachine::write_probe(row), [&] {
      return fmt::format("PROBE DATA {} CAL_OF1{:+.4f} CAL_OF2{:+.4f}", row.number, row.cal_of1,
                         row.cal_of2);
    });
  }
  MachineResult<void> write_preset(const Preset& preset) override {
    return write(SimulatedMachine::write_preset(preset), [&] {
      return fmt::format("PRESET ROW {} {} {}", preset.number, text_of(preset.frame.origin),
                         angles("SP", preset.frame.basic_rotation_deg));
    });
  }
  MachineResult<void> write_tool_touch_probe(const ToolTouchProbe& tt) override {
    return write(SimulatedMachine::write_tool_touch_probe(tt),
                 [&] { return fmt::format("TT {} R{:+.4f}", text_of(tt.centre), tt.radius); });
  }
  MachineResult<void> activate_preset(int number) override {
    return write(SimulatedMachine::activate_preset(number),
                 [&] { return fmt::format("PRESET {}", number); });
  }
  MachineResult<void> set_frames(const Frames& frames) override {
    return write(SimulatedMachine::set_frames(frames), [&] { return text_of(frames); });
  }
  MachineResult<void> set_modes(const Modes& modes) override {
    return write(SimulatedMachine::set_modes(modes), [&] {
      std::string text = fmt::format("MODES SPINDLE {} S{:g} COOLANT {} F{:g} TCPM {}",
                                     static_cast<int>(modes.spindle), modes.spindle_rpm,
                                     modes.coolant ? 1 : 0, modes.feed_mm_min, modes.tcpm ? 1 : 0);
      if (modes.spindle_deg != 0) text += fmt::format(" ORIENTED {:g}", modes.spindle_deg);
      return text;
    });
  }
  MachineResult<void> set_kinematics(const Kinematics& kinematics) override {
    return write(SimulatedMachine::set_kinematics(kinematics), [&] {
      std::string text = "KINEMATICS";
      for (const RotaryAxis& axis : kinematics.axes()) {
        text += fmt::format(" {} {}", name(axis.axis), text_of(axis.centre));
      }
      return text;
    });
  }
  MachineResult<void> dwell(double seconds) override {
    return write(SimulatedMachine::dwell(seconds),
                 [&] { return fmt::format("DWELL {:g}", seconds); });
  }
  void stop(std::string_view reason) override {
    SimulatedMachine::stop(reason);
    write(MachineResult<void>(), [&] { return fmt::format("STOP {}", reason); });
  }

 private:
  static std::string text_of(const auto&... values) { return trace_text::text_of(values...); }
  static std::string angles(std::string_view prefix, const Vec3& a) {
    return trace_text::angles(prefix, a);
  }
  /// Writes the line that `text()` makes, with the fault if there is one. @returns the result
  template <class T, class Text>
  MachineResult<T> write(MachineResult<T> result, const Text& text) {
    if (lines_.size() < lines_most_) {
      lines_.push_back(result ? text() : fmt::format("{} ! {}", text(), result.error().text));
    }
    return result;
  }

  std::size_t lines_most_;
  std::vector<std::string> lines_;
};

}  // namespace fitgauge::machine
