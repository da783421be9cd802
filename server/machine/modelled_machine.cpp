#include "machine/modelled_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace fitgauge::machine {
namespace {

constexpr double kSecondsPerMinute = 60;

MachineResult<void> check_feed(const Feed& feed) {
  const bool is_usable = feed.rate > 0 && (feed.is_rapid || std::isfinite(feed.rate));
  if (is_usable) return {};
  return make_fault(FaultKind::FeedMissing, fmt::format("a feed of {} mm/min", feed.rate));
}

MachineResult<void> check_finite(const AxisWords& words) {
  for (const Axis axis : kAllAxes) {
    if (words[axis] && !std::isfinite(*words[axis])) {
      return make_fault(FaultKind::ValueInvalid, fmt::format("{} is not a number", name(axis)));
    }
  }
  return {};
}

Position start_of(const MachineSetup& setup) {
  Position start;
  for (const Axis axis : kAllAxes) {
    if (setup.start[axis]) {
      start[axis] = *setup.start[axis];
    } else if (axis == Axis::Z && setup.axes[index(axis)]) {
      start[axis] = setup.axes[index(axis)]->max;
    }
  }
  return start;
}

}  // namespace

ModelledMachine::ModelledMachine(const MachineSetup& setup) {
  std::vector<RotaryAxis> rotary;
  for (const Axis axis : kAllAxes) {
    const auto& known = setup.axes[index(axis)];
    if (!known) continue;
    state_.ranges[index(axis)] = AxisRange{known->min, known->max, known->hirth_grid_deg};
    if (is_rotary(axis)) rotary.push_back({axis, known->mount, known->centre, known->direction});
  }
  state_.kinematics = Kinematics(std::move(rotary));
  for (const ToolSetup& tool : setup.tools) state_.tools.write(tool.row);
  for (const ProbeSetup& probe : setup.probes) state_.probes.write(probe.row);
  for (const Preset& preset : setup.presets) state_.presets.write(preset);
  state_.active_preset = setup.active_preset;
  if (const Preset* preset = state_.presets.find(setup.active_preset)) {
    state_.frames.set_preset(preset->frame);
  }
  state_.rapid_mm_min = setup.rapid_mm_min;
  state_.nose = start_of(setup);
}

// ---- moving

MachineResult<void> ModelledMachine::move(const LinearMove& move) {
  if (auto checked = check_feed(move.feed); !checked) return checked;
  if (auto checked = check_finite(move.target); !checked) return checked;
  const auto rotary = target_rotary(move);
  if (!rotary) return rotary.error();
  const bool turns = *rotary != state_.nose.rotary;
  std::optional<Frames> turned;
  if (turns && is_following()) {
    turned = state_.frames;
    turned->set_table(table_at(*rotary));
  }
  const auto nose = target_nose(move, turned ? *turned : state_.frames, *rotary);
  if (!nose) return nose.error();
  if (auto checked = check_range(*nose); !checked) return checked;
  return travel(
      turns && state_.modes.tcpm ? following_path(*nose) : straight_path(state_.nose, *nose),
      move.feed);
}

MachineResult<Vec3> ModelledMachine::target_rotary(const LinearMove& move) const {
  Vec3 rotary = state_.nose.rotary;
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    const auto& word = move.target[axis];
    if (!word) continue;
    const auto& range = state_.ranges[index(axis)];
    if (!range) return make_fault(FaultKind::AxisMissing, name(axis));
    const std::size_t letter = index(axis) - 3;
    Vec3 programmed;
    programmed[letter] = *word;
    rotary[letter] = state_.frames.rotary_to_machine(programmed, move.system)[letter];
    const double grid = range->hirth_grid_deg;
    constexpr double kOnTooth = 1e-6;
    if (grid > 0 && std::abs(std::remainder(rotary[letter], grid)) > kOnTooth) {
      return make_fault(FaultKind::HirthGrid, fmt::format("{}{:+.4f} with a grid of {} degrees",
                                                          name(axis), rotary[letter], grid));
    }
  }
  return rotary;
}

/// Where the nose ends with the rotary axes at `rotary`; `frames` are those that hold there.
MachineResult<Position> ModelledMachine::target_nose(const LinearMove& move, const Frames& frames,
                                                     const Vec3& rotary) const {
  bool has_linear = false;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    has_linear = has_linear || move.target[axis];
    if (move.target[axis] && !state_.ranges[index(axis)]) {
      return make_fault(FaultKind::AxisMissing, name(axis));
    }
  }
  Vec3 point = state_.nose.linear;
  const auto take_words = [&] {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
      point[index(axis)] = move.target[axis].value_or(point[index(axis)]);
    }
  };
  if (move.system == CoordinateSystem::Reference || (!has_linear && !state_.modes.tcpm)) {
    take_words();
    return Position{point, rotary};
  }
  const Vec3 length =
      state_.kinematics.tool_direction(rotary, state_.tool_axis()) * state_.tool_length();
  point = state_.modes.tcpm ? state_.position(move.system).linear
                            : frames.from_machine(state_.nose.linear - length, move.system);
  take_words();
  return Position{frames.to_machine(point, move.system) + length, rotary};
}

/// With TCPM the tip runs straight on the table while the rotary axes turn.
Path ModelledMachine::following_path(const Position& end) const {
  const Kinematics kinematics = state_.kinematics;
  const Axis axis = state_.tool_axis();
  const double length = state_.tool_length();
  const Position start = state_.nose;
  const auto tip_on_table = [&](const Position& nose) {
    const Vec3 tip = nose.linear - kinematics.tool_direction(nose.rotary, axis) * length;
    return kinematics.table(nose.rotary).inverse().point(tip);
  };
  const Vec3 from = tip_on_table(start);
  const Vec3 way = tip_on_table(end) - from;
  const Vec3 turn = end.rotary - start.rotary;

  Path path = straight_path(start, end);
  path.nose = [=](double part) {
    const Vec3 rotary = start.rotary + turn * part;
    return Position{kinematics.table(rotary).point(from + way * part) +
                        kinematics.tool_direction(rotary, axis) * length,
                    rotary};
  };
  path.length = norm(way);
  double lever = std::abs(length) + norm(from) + norm(way);
  for (const RotaryAxis& known : kinematics.axes()) lever += 2 * norm(known.centre);
  path.nose_speed =
      path.length + radians(std::abs(turn.x) + std::abs(turn.y) + std::abs(turn.z)) * lever;
  return path;
}

MachineResult<void> ModelledMachine::move_arc(const ArcMove& arc) {
  if (auto checked = check_feed(arc.feed); !checked) return checked;
  constexpr double kLongestSweepDeg = 1e6;
  if (!is_finite(arc.end) || !is_finite(arc.centre) || is_rotary(arc.normal) ||
      !(std::abs(arc.sweep_deg) <= kLongestSweepDeg)) {
    return make_fault(FaultKind::ValueInvalid, "an arc needs finite points, a sweep and a plane");
  }
  const std::size_t up = index(arc.normal);
  const Vec3 normal = unit_vector(arc.normal);
  const Transform input = state_.frames.input();
  const Vec3 start = state_.position().linear;
  const Vec3 rotary = state_.nose.rotary;
  const Vec3 length = state_.nose.linear - input.point(start);
  Vec3 from = start - arc.centre;
  Vec3 to = arc.end - arc.centre;
  const double rise = to[up] - from[up];
  from[up] = 0;
  to[up] = 0;
  const Matrix3 back = Matrix3::rotation(normal, -arc.sweep_deg);
  // The end's direction turned back differs from the start's by the rounding of the program only:
  // spread over the arc, it meets both ends.
  const Vec3 difference = back * to - from;

  Path path;
  path.start = state_.nose;
  path.nose = [=](double part) {
    Vec3 point =
        arc.centre + Matrix3::rotation(normal, arc.sweep_deg * part) * (from + difference * part);
    point[up] = start[up] + rise * part;
    return Position{input.point(point) + length, rotary};
  };
  path.end = path.nose(1);
  path.is_straight = false;
  const Vec3 scale = state_.frames.scaling().factor;
  const double stretch = std::max({std::abs(scale.x), std::abs(scale.y), std::abs(scale.z)});
  const double sweep = std::abs(arc.sweep_deg);
  const double radius = std::max(norm(from), norm(to));
  path.length = stretch * std::hypot(radians(sweep) * (norm(from) + norm(to)) / 2, rise);
  path.nose_speed =
      stretch * (radians(sweep) * (radius + norm(difference)) + norm(difference) + std::abs(rise));
  if (auto checked = check_arc(path, sweep); !checked) return checked;
  return travel(path, arc.feed);
}

/// The ends first; then, unless everything that near to the start is in range, every 0.1 degrees.
MachineResult<void> ModelledMachine::check_arc(const Path& path, double sweep_deg) const {
  if (auto checked = check_range(path.end); !checked) return checked;
  bool is_clear = true;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const auto& range = state_.ranges[index(axis)];
    const double at = path.start[axis];
    is_clear =
        is_clear && range && at - path.nose_speed > range->min && at + path.nose_speed < range->max;
  }
  if (is_clear) return {};
  constexpr double kStepDeg = 0.1;
  const auto steps = static_cast<int>(sweep_deg / kStepDeg) + 1;
  for (int step = 1; step < steps; ++step) {
    if (auto checked = check_range(path.nose(static_cast<double>(step) / steps)); !checked) {
      return checked;
    }
  }
  return {};
}

MachineResult<void> ModelledMachine::check_range(const Position& nose) const {
  for (const Axis axis : kAllAxes) {
    const auto& range = state_.ranges[index(axis)];
    if (!range) continue;
    constexpr double kRounding = 1e-9;  // a position computed to lie on the limit is in range
    const double at = nose[axis];
    if (at >= range->min - kRounding && at <= range->max + kRounding) continue;
    return make_fault(FaultKind::AxisLimit, fmt::format("{}{:+.4f} is outside {} to {}", name(axis),
                                                        at, range->min, range->max));
  }
  return {};
}

Transform ModelledMachine::table_at(const Vec3& rotary) const {
  return state_.kinematics.table(rotary);
}

void ModelledMachine::stand_at(const Position& nose) {
  const bool has_turned = nose.rotary != state_.nose.rotary;
  state_.nose = nose;
  if (has_turned && is_following()) state_.frames.set_table(table_at(nose.rotary));
}

MachineResult<void> ModelledMachine::travel(const Path& path, const Feed& feed) {
  if (path.end.rotary != path.start.rotary) on_turn(path.end.rotary);
  const double part = free_part(path);
  const double rate = feed.is_rapid ? std::min(feed.rate, state_.rapid_mm_min) : feed.rate;
  state_.elapsed_s += part * std::max(path.length, path.turn) / rate * kSecondsPerMinute;
  stand_at(part < 1 ? path.nose(part) : path.end);
  if (part == 1) return {};
  const Vec3 centre = state_.ball_centre();
  return make_fault(
      FaultKind::Collision,
      fmt::format("the ball stands at X{:+.4f} Y{:+.4f} Z{:+.4f}", centre.x, centre.y, centre.z));
}

// ---- probing

MachineResult<ContactPoint> ModelledMachine::probe(const ProbeMove& move) {
  if (!state_.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  if (state_.active_tool() == nullptr) return make_fault(FaultKind::NoTool);
  if (auto checked = check_feed(Feed::at(move.feed)); !checked) return checked.error();
  if (auto checked = check_feed(move.retract_feed); !checked) return checked.error();
  const Vec3 along = state_.frames.direction_to_machine(move.direction, move.system);
  const double retract = move.retract.value_or(0);
  if (!is_finite(along) || norm(along) == 0 || !std::isfinite(move.distance) ||
      move.distance <= 0 || !std::isfinite(retract) || retract < 0) {
    return make_fault(FaultKind::ValueInvalid, "a probing move needs a direction and a distance");
  }
  const Vec3 direction = unit(along);
  const double reachable = reach(direction, move.distance);
  const auto travelled = contact(direction, reachable);
  const bool is_missed = !travelled && travelled.error().kind == FaultKind::NoContact;
  if (!travelled && !is_missed) return travelled.error();

  const double way = is_missed ? reachable : *travelled;
  const double seconds = way / move.feed * kSecondsPerMinute;
  advance(direction * way);
  state_.elapsed_s += seconds;
  if (is_missed && reachable < move.distance) {
    return check_range(
               {state_.nose.linear + direction * (move.distance - reachable), state_.nose.rotary})
        .error();
  }
  if (is_missed) return travelled.error();

  ContactPoint point = contact_point(direction);
  point.seconds = seconds;
  if (auto returned = go_back(direction, way, move); !returned) return returned.error();
  return point;
}

/// The way back to the start is free, since the ball came along it; beyond it is looked at.
MachineResult<void> ModelledMachine::go_back(const Vec3& direction, double way,
                                             const ProbeMove& move) {
  const double back = move.retract.value_or(way);
  const double free = std::min(back, way);
  const double rate = move.retract_feed.is_rapid
                          ? std::min(move.retract_feed.rate, state_.rapid_mm_min)
                          : move.retract_feed.rate;
  advance(direction * -free);
  state_.elapsed_s += free / rate * kSecondsPerMinute;
  if (back == free) return {};
  const Position end{state_.nose.linear - direction * (back - free), state_.nose.rotary};
  if (auto checked = check_range(end); !checked) return checked;
  return travel(straight_path(state_.nose, end), move.retract_feed);
}

/// How far the nose can go along `direction` inside its ranges, at most `distance`.
double ModelledMachine::reach(const Vec3& direction, double distance) const {
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    const auto& range = state_.ranges[index(axis)];
    const double part = direction[index(axis)];
    if (!range || part == 0) continue;
    const double end = part > 0 ? range->max : range->min;
    distance = std::min(distance, std::max((end - state_.nose[axis]) / part, 0.0));
  }
  return distance;
}

ContactPoint ModelledMachine::contact_point(const Vec3& direction) const {
  const Frames& frames = state_.frames;
  Vec3 centre = state_.ball_centre(CoordinateSystem::Machine);
  if (const auto probe = state_.probe_system()) {
    centre = centre + probe->centre_offset(state_.tool_axis());
  }
  ContactPoint point;
  point.tip_machine =
      centre - state_.tool_direction(CoordinateSystem::Machine) * state_.tool_radius();
  point.tip = frames.from_machine(point.tip_machine);
  point.ball_centre = frames.from_machine(centre);
  point.surface = frames.from_machine(centre + direction * state_.tool_radius());
  point.nose = state_.nose;
  return point;
}

// ---- tables, frames, modes

MachineResult<void> ModelledMachine::call_tool(const ToolCall& call) {
  if (!call.axis && !state_.tool.axis) return make_fault(FaultKind::ToolAxisMissing);
  if (call.axis && is_rotary(*call.axis)) {
    return make_fault(FaultKind::ValueInvalid, "the tool axis is X, Y or Z");
  }
  if (!is_finite({call.dl, call.dr, call.dr2}) || !(call.spindle_rpm.value_or(0) >= 0)) {
    return make_fault(FaultKind::ValueInvalid, "S, DL, DR and DR2 of a tool call are numbers");
  }
  if (call.number && *call.number != 0) {
    const Tool* tool = state_.tools.find(*call.number);
    if (tool == nullptr) {
      return make_fault(FaultKind::ToolUnknown, fmt::format("tool {}", *call.number));
    }
    if (tool->locked)
      return make_fault(FaultKind::ToolLocked, fmt::format("tool {}", *call.number));
  }
  if (call.number) state_.tool = {*call.number, state_.tool.axis, call.dl, call.dr, call.dr2};
  if (call.axis) state_.tool.axis = call.axis;
  if (call.spindle_rpm) state_.modes.spindle_rpm = *call.spindle_rpm;
  return {};
}

MachineResult<void> ModelledMachine::write_tool(const Tool& tool) {
  if (!is_finite({tool.l, tool.r, tool.r2}) || !is_finite({tool.dl, tool.dr, tool.dr2})) {
    return make_fault(FaultKind::ValueInvalid, fmt::format("lengths of tool {}", tool.number));
  }
  state_.tools.write(tool);
  return {};
}

MachineResult<void> ModelledMachine::write_probe(const ProbeRow& row) {
  if (!is_finite({row.cal_of1, row.cal_of2, row.cal_ang}) ||
      !is_finite({row.feed, row.rapid, row.distance + row.set_up})) {
    return make_fault(FaultKind::ValueInvalid, fmt::format("values of probe {}", row.number));
  }
  state_.probes.write(row);
  return {};
}

MachineResult<void> ModelledMachine::write_preset(const Preset& preset) {
  const auto& [origin, rotation, offsets] = preset.frame;
  if (!is_finite(origin) || !is_finite(rotation) || !is_finite(offsets) || preset.number < 0) {
    return make_fault(FaultKind::ValueInvalid, fmt::format("values of preset {}", preset.number));
  }
  const Preset* old = state_.presets.find(preset.number);
  if (old != nullptr && old->locked) {
    return make_fault(FaultKind::PresetLocked, fmt::format("preset {}", preset.number));
  }
  state_.presets.write(preset);
  return {};
}

MachineResult<void> ModelledMachine::activate_preset(int number) {
  const Preset* preset = state_.presets.find(number);
  if (preset == nullptr) return make_fault(FaultKind::PresetUnknown, fmt::format("row {}", number));
  state_.active_preset = number;
  state_.frames.reset_transformations();
  state_.frames.set_preset(preset->frame);
  return {};
}

MachineResult<void> ModelledMachine::set_frames(const Frames& frames) {
  if (!frames.is_valid()) {
    return make_fault(FaultKind::ValueInvalid, "a frame is not finite or scales by 0");
  }
  state_.frames = frames;
  refresh_table();
  return {};
}

MachineResult<void> ModelledMachine::set_modes(const Modes& modes) {
  if (!(modes.spindle_rpm >= 0) || !(modes.feed_mm_min >= 0)) {
    return make_fault(FaultKind::ValueInvalid, "spindle speed and feed are 0 or more");
  }
  state_.modes = modes;
  refresh_table();
  return {};
}

MachineResult<void> ModelledMachine::set_kinematics(const Kinematics& kinematics) {
  for (const RotaryAxis& axis : kinematics.axes()) {
    if (!state_.ranges[index(axis.axis)])
      return make_fault(FaultKind::AxisMissing, name(axis.axis));
    if (!is_finite(axis.centre) || !is_finite(axis.direction)) {
      return make_fault(FaultKind::ValueInvalid, fmt::format("kinematics of {}", name(axis.axis)));
    }
  }
  state_.kinematics = kinematics;
  refresh_table();
  return {};
}

void ModelledMachine::refresh_table() {
  state_.frames.set_table(is_following() ? table_at(state_.nose.rotary) : Transform{});
}

MachineResult<void> ModelledMachine::dwell(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) {
    return make_fault(FaultKind::ValueInvalid, fmt::format("a dwell of {} s", seconds));
  }
  state_.elapsed_s += seconds;
  return {};
}

void ModelledMachine::stop(std::string_view) {}
void ModelledMachine::message(std::string_view) {}

}  // namespace fitgauge::machine
