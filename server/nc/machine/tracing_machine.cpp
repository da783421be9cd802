#include "nc/machine/tracing_machine.hpp"

#include "base/text.hpp"

namespace fitgauge::machine {
namespace {

/// "+1.2500": to 0.1 um, and zero is never negative.
std::string number(double value) {
  constexpr double kHalfStep = 0.00005;
  return fmt::format("{:+.4f}", std::abs(value) < kHalfStep ? 0.0 : value);
}

/// "X+1.0000 Y-2.5000 Z+0.0000".
std::string text_of(const Vec3& p) {
  return fmt::format("X{} Y{} Z{}", number(p.x), number(p.y), number(p.z));
}

/// "PREFIXA+1.0000 PREFIXB+2.0000 PREFIXC+3.0000".
std::string angles(std::string_view prefix, const Vec3& a) {
  return fmt::format("{0}A{1} {0}B{2} {0}C{3}", prefix, number(a.x), number(a.y), number(a.z));
}

/// The linear axes, and the rotary ones that the machine has.
std::string text_of(const Position& position, const MachineState& state) {
  std::string text = text_of(position.linear);
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    if (!state.ranges[index(axis)]) continue;
    text += fmt::format(" {}{}", name(axis), number(position[axis]));
  }
  return text;
}

std::string text_of(const Feed& feed) {
  if (!feed.is_rapid) return fmt::format("F{:g}", feed.rate);
  return std::isfinite(feed.rate) ? fmt::format("FMAX {:g}", feed.rate) : "FMAX";
}

std::string text_of(const Frames& frames) {
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

std::string text_of(const ToolCall& call) {
  std::string text = "TOOL CALL";
  if (call.number) text += fmt::format(" {}", *call.number);
  if (call.axis) text += fmt::format(" {}", name(*call.axis));
  if (call.spindle_rpm) text += fmt::format(" S{:g}", *call.spindle_rpm);
  return text + fmt::format(" DL{:+.4f} DR{:+.4f}", call.dl, call.dr);
}

}  // namespace

std::string_view name(MoveKind kind) { return word_of(kind, {"rapid", "feed", "probe", "arc"}); }

TracingMachine::TracingMachine(Machine& inner, TraceOptions options)
    : inner_(inner), options_(std::move(options)) {}

template <class T, class Text>
MachineResult<T> TracingMachine::write(MachineResult<T> result, const Text& text) {
  if (options_.lines && lines_.size() < options_.longest) {
    lines_.push_back(result ? text() : fmt::format("{} ! {}", text(), result.error().text));
  }
  return result;
}

void TracingMachine::add(const TracedMove& move) {
  if (is_full()) {
    ++dropped_;
    return;
  }
  ++kept_;
  if (options_.keep) options_.keep(move);
}

void TracingMachine::keep(MoveKind kind, const Begun& begun, const Feed& feed,
                          const std::optional<TracedArc>& arc) {
  const Position end = state().position();
  const double seconds = state().elapsed_s - begun.elapsed_s;
  if (seconds == 0 && end == begun.start) return;
  add({.kind = kind,
       .start = begun.start,
       .end = end,
       .feed_mm_min = feed.rate_on(state().rapid_mm_min),
       .seconds = seconds,
       .machine_start = begun.machine_start,
       .machine_end = machine_tip(),
       .arc = arc});
}

/// An arc in the machine's coordinates, where a mirror turns it the other way round.
TracedArc TracingMachine::traced(const ArcMove& arc, const Begun& begun) const {
  const Frames& frames = state().frames;
  const std::size_t up = index(arc.normal);
  TracedArc traced{.centre = arc.centre, .sweep_deg = arc.sweep_deg, .axis = arc.normal};
  traced.centre[up] = begun.start.linear[up];
  traced.machine_centre = frames.to_machine(traced.centre);
  const auto direction = [&](Axis axis) {
    return frames.direction_to_machine(unit_vector(axis), CoordinateSystem::Input);
  };
  const auto next = [](Axis axis) { return static_cast<Axis>((index(axis) + 1) % 3); };
  traced.machine_axis = unit(cross(direction(next(arc.normal)), direction(next(next(arc.normal)))));
  return traced;
}

MachineResult<void> TracingMachine::move(const LinearMove& move) {
  const Begun begun = begin();
  auto result = inner_.move(move);
  keep(move.feed.is_rapid ? MoveKind::Rapid : MoveKind::Feed, begun, move.feed);
  return write(result, [&] {
    return fmt::format("L {} {}", text_of(state().position(), state()), text_of(move.feed));
  });
}

MachineResult<void> TracingMachine::move_arc(const ArcMove& arc) {
  const Begun begun = begin();
  const TracedArc kept = traced(arc, begun);
  auto result = inner_.move_arc(arc);
  keep(MoveKind::Arc, begun, arc.feed, kept);
  return write(result, [&] {
    return fmt::format("ARC {} CC {} {:+.4f} {}", text_of(state().position(), state()),
                       text_of(arc.centre), arc.sweep_deg, text_of(arc.feed));
  });
}

MachineResult<ContactPoint> TracingMachine::probe(const ProbeMove& move) {
  const Begun begun = begin();
  auto result = inner_.probe(move);
  keep_probing(begun, move, result);
  return write(result, [&] {
    return fmt::format("PROBE {} F{:g}{}", text_of(move.direction), move.feed,
                       result ? " TOUCHED " + text_of(result->surface) : std::string());
  });
}

void TracingMachine::keep_probing(const Begun& begun, const ProbeMove& move,
                                  const MachineResult<ContactPoint>& result) {
  const Feed feed = Feed::at(move.feed);
  if (!result) {
    keep(MoveKind::Probe, begun, feed);
    return;
  }
  Position touching = begun.start;
  const double travelled = result->seconds * move.feed / 60;
  const Frames& frames = state().frames;
  const Vec3 along = unit(frames.direction_to_machine(move.direction, move.system));
  touching.linear = frames.from_machine(frames.to_machine(begun.start.linear) + along * travelled);
  const Vec3 machine_touching = begun.machine_start + along * travelled;
  add({.kind = MoveKind::Probe,
       .start = begun.start,
       .end = touching,
       .feed_mm_min = move.feed,
       .seconds = result->seconds,
       .machine_start = begun.machine_start,
       .machine_end = machine_touching,
       .contact = TracedContact{.surface = result->surface,
                                .machine_surface = frames.to_machine(result->surface),
                                .normal = is_full() ? std::nullopt : inner_.contact_normal()}});
  keep(move.retract_feed.is_rapid ? MoveKind::Rapid : MoveKind::Feed,
       {touching, machine_touching, begun.elapsed_s + result->seconds}, move.retract_feed);
}

MachineResult<void> TracingMachine::call_tool(const ToolCall& call) {
  return write(inner_.call_tool(call), [&] { return text_of(call); });
}

MachineResult<void> TracingMachine::write_tool(const Tool& tool) {
  return write(inner_.write_tool(tool), [&] {
    return fmt::format("TOOL {} L{:+.4f} R{:+.4f} DL{:+.4f} DR{:+.4f}{}", tool.number, tool.l,
                       tool.r, tool.dl, tool.dr, tool.locked ? " LOCKED" : "");
  });
}

MachineResult<void> TracingMachine::write_probe(const ProbeRow& row) {
  return write(inner_.write_probe(row), [&] {
    return fmt::format("PROBE DATA {} CAL_OF1{:+.4f} CAL_OF2{:+.4f}", row.number, row.cal_of1,
                       row.cal_of2);
  });
}

MachineResult<void> TracingMachine::write_preset(const Preset& preset) {
  return write(inner_.write_preset(preset), [&] {
    return fmt::format("PRESET ROW {} {} {}", preset.number, text_of(preset.frame.origin),
                       angles("SP", preset.frame.basic_rotation_deg));
  });
}

MachineResult<void> TracingMachine::write_tool_touch_probe(const ToolTouchProbe& tt) {
  return write(inner_.write_tool_touch_probe(tt),
               [&] { return fmt::format("TT {} R{:+.4f}", text_of(tt.centre), tt.radius); });
}

MachineResult<void> TracingMachine::activate_preset(int number) {
  return write(inner_.activate_preset(number), [&] { return fmt::format("PRESET {}", number); });
}

MachineResult<void> TracingMachine::set_frames(const Frames& frames) {
  return write(inner_.set_frames(frames), [&] { return text_of(frames); });
}

MachineResult<void> TracingMachine::set_modes(const Modes& modes) {
  return write(inner_.set_modes(modes), [&] {
    std::string text = fmt::format("MODES SPINDLE {} S{:g} COOLANT {} F{:g} TCPM {}",
                                   static_cast<int>(modes.spindle), modes.spindle_rpm,
                                   modes.coolant ? 1 : 0, modes.feed_mm_min, modes.tcpm ? 1 : 0);
    if (modes.spindle_deg != 0) text += fmt::format(" ORIENTED {:g}", modes.spindle_deg);
    return text;
  });
}

MachineResult<void> TracingMachine::set_kinematics(const Kinematics& kinematics) {
  return write(inner_.set_kinematics(kinematics), [&] {
    std::string text = "KINEMATICS";
    for (const RotaryAxis& axis : kinematics.axes()) {
      text += fmt::format(" {} {}", name(axis.axis), text_of(axis.centre));
    }
    return text;
  });
}

MachineResult<void> TracingMachine::dwell(double seconds) {
  return write(inner_.dwell(seconds), [&] { return fmt::format("DWELL {:g}", seconds); });
}

void TracingMachine::stop(std::string_view reason) {
  inner_.stop(reason);
  write(MachineResult<void>(), [&] { return fmt::format("STOP {}", reason); });
}

void TracingMachine::message(std::string_view text) {
  inner_.message(text);
  write(MachineResult<void>(), [&] { return fmt::format("MESSAGE {}", text); });
}

}  // namespace fitgauge::machine
