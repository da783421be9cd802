#include "nc/run/statements.hpp"

namespace fitgauge::interpreter {
namespace {

using klartext::PlanePositioning;

using Words = std::span<const Word>;
using AxisCoordinates = std::array<std::optional<Coordinate>, kAxes>;

template <class Change>
NcResult<void> change_frames(Channel& channel, const Change& change) {
  Frames frames = channel.state().frames;
  change(frames);
  return channel.machine().set_frames(frames);
}

/// TABLE ROT (decision 31): the table axis next to the workpiece is free if it is parallel to the
/// tool in the plane. It turns until the plane's main axis is along the machine's.
void turn_free_axis(const MachineState& state, const Frames& plane, Vec3& rotary) {
  const auto& axes = state.kinematics.axes();
  const auto next_to_workpiece = std::find_if(axes.rbegin(), axes.rend(), [](const auto& axis) {
    return axis.mount == machine::AxisMount::Table;
  });
  if (next_to_workpiece == axes.rend()) return;
  const auto working = WorkingPlane::across(state.tool_axis());
  const Vec3 normal = unit(plane.direction_to_machine(unit_vector(state.tool_axis())));
  const double along = dot(normal, next_to_workpiece->direction);
  if (std::abs(along) < 1 - tolerance::kSameDirection) return;
  double& angle = rotary[index(next_to_workpiece->axis) - 3];
  angle = 0;
  const Vec3 main_axis = state.kinematics.table(rotary).direction(
      plane.direction_to_machine(unit_vector(static_cast<Axis>(working.first))));
  const Vec2 seen = working.project(main_axis);
  const double turn = machine::degrees(std::atan2(seen.y, seen.x));
  angle = along > 0 ? turn : -turn;
  if (angle < -180 + tolerance::kSameDirection) angle = 180;
}

/// SEQ and SYM: the first axis that is not C, of the head from the tool, has a sign of its angle
/// from 0 or from the middle of its range.
bool is_on_side(const MachineState& state, const PlaneMoves& moves, const Vec3& rotary) {
  const auto& axes = state.kinematics.axes();
  const auto primary =
      std::find_if(axes.begin(), axes.end(), [](const auto& axis) { return axis.axis != Axis::C; });
  if (moves.sequence == 0 || primary == axes.end()) return true;
  const auto& range = state.ranges[index(primary->axis)];
  const double zero = moves.is_symmetric && range ? (range->min + range->max) / 2 : 0;
  const double angle = rotary[index(primary->axis) - 3] - zero;
  return moves.sequence > 0 ? angle >= 0 : angle <= 0;
}

/// Returns the rotary positions for a plane: the nearest in range on the side that SEQ or SYM
/// requests.
NcResult<std::optional<Vec3>> rotary_positions(Channel& channel, const Frames& frames,
                                               const PlaneMoves& moves) {
  const MachineState& state = channel.state();
  Frames plane;
  plane.set_preset(frames.preset());
  plane.set_plane(frames.plane());
  const Vec3 normal = unit(plane.direction_to_machine(unit_vector(state.tool_axis())));
  for (const Vec3& found :
       state.kinematics.orientations(normal, state.nose.rotary, state.tool_axis())) {
    auto rotary = in_range(state, found, found);
    if (!rotary || !is_on_side(state, moves, *rotary)) continue;
    if (moves.turns_table) turn_free_axis(state, plane, *rotary);
    return rotary;
  }
  const bool turns =
      moves.positioning == PlanePositioning::Turn || moves.positioning == PlanePositioning::Move;
  if (turns || !state.kinematics.axes().empty())
    return nc_error(1013, "no position of the rotary axes reaches the plane");
  TRY(channel.note(
      "the machine of the setup has no rotary axes: the coordinates tilt, the tool does not"));
  return std::optional<Vec3>();
}

/// Along the tool to the spindle, in input coordinates, with the rotary axes at `rotary`.
Vec3 tool_at(const MachineState& state, const Vec3& rotary) {
  Frames on_table = state.frames;
  on_table.set_table({});
  const Vec3 tool = state.kinematics.tool_on_table(rotary, state.tool_axis());
  return unit(on_table.direction_from_machine(tool));
}

/// Turns the axes to `rotary`, in input coordinates `shown`. MOVE keeps the tip in place on the
/// workpiece, TURN does not move the linear axes.
NcResult<void> turn(Channel& channel, const Vec3& rotary, const Vec3& shown,
                    const PlaneMoves& moves) {
  Machine& machine = channel.machine();
  if (moves.retraction) TRY(retract(channel, *moves.retraction));
  const Modes before = machine.state().modes;
  Modes during = before;
  during.tcpm = moves.positioning == PlanePositioning::Move;
  TRY(machine.set_modes(during));
  AxisWords target;
  for (const RotaryAxis& axis : machine.state().kinematics.axes())
    target[axis.axis] = shown[index(axis.axis) - 3];
  if (during.tcpm && moves.distance != 0) {
    const MachineState& state = machine.state();
    const Vec3 swing = tool_at(state, rotary) - tool_at(state, state.nose.rotary);
    const Vec3 tip = machine.position().linear + swing * moves.distance;
    for (std::size_t axis = 0; axis < 3; ++axis) target.values[axis] = tip[axis];
  }
  auto moved = machine.move({target, moves.feed});
  TRY(machine.set_modes(before));
  return moved;
}

NcResult<void> apply(Channel& channel, const Frames& frames, const std::optional<Vec3>& rotary,
                     const PlaneMoves& moves) {
  TRY(channel.machine().set_frames(frames));
  if (!rotary) return {};
  const Vec3 shown = frames.rotary_from_machine(*rotary, CoordinateSystem::Input);
  set_plane_angles(channel, shown);
  const bool turns =
      moves.positioning == PlanePositioning::Turn || moves.positioning == PlanePositioning::Move;
  return turns ? turn(channel, *rotary, shown, moves) : NcResult<void>();
}

/// The datum shift relative to the workpiece system, tilted or not.
Position untilted_shift(const Frames& frames) {
  Position shift = frames.datum_shift();
  if (frames.plane()) shift.linear = frames.plane()->origin;
  return shift;
}

const Word* find(Words words, Letter letter) {
  const auto it = std::ranges::find(words, letter, &Word::letter);
  return it == words.end() ? nullptr : &*it;
}

/// The number of a word, or `otherwise` if it is absent.
NcResult<double> value(Channel& channel, Words words, Letter letter, double otherwise) {
  const Word* word = find(words, letter);
  if (word == nullptr || is_absent(word->value)) return otherwise;
  return number(channel, word->value);
}

/// The axis words of a transformation with their values, in mm and degrees; other words are
/// ignored. Decision 3 applies: an undefined parameter is an error.
NcResult<AxisCoordinates> read_axis_words(Channel& channel, Words words) {
  AxisCoordinates axes;
  for (const Word& word : words) {
    if (!is_axis(word.letter) || is_absent(word.value)) continue;
    const auto axis = TRY(machine_axis(word.letter));
    const auto value = TRY(number(channel, word.value));
    const double unit = is_rotary(axis) ? 1 : channel.length_unit();
    axes[index(axis)] = Coordinate{value * unit, word.incremental};
  }
  return axes;
}

/// Axes that are not named keep their shift.
NcResult<void> shift_datum(Channel& channel, const AxisCoordinates& axes) {
  return change_frames(channel, [&](Frames& frames) {
    Position shift = frames.datum_shift();
    for (const Axis axis : kAllAxes) {
      const auto& word = axes[index(axis)];
      if (word) shift[axis] = word->after(shift[axis]);
    }
    frames.set_datum_shift(shift);
  });
}

NcResult<void> datum_shift(Channel& channel, Words words) {
  if (const Word* row = find(words, Letter::Row))
    return shift_datum_to_row(channel, TRY(whole(channel, row->value)));
  const auto axes = TRY(read_axis_words(channel, words));
  for (const Axis axis : kAllAxes) {
    if (axes[index(axis)] && !channel.state().ranges[index(axis)])
      return make_fault(machine::FaultKind::AxisMissing, name(axis));
  }
  return shift_datum(channel, axes);
}

/// Tolerance of the path, which a simulated path does not have.
NcResult<void> tolerance(Channel& channel, Words words) {
  const auto width = TRY(value(channel, words, Letter::T, 0));
  if (width < 0) return nc_error(1004, "T of cycle 32 is {}", width);
  return {};
}

/// The spindle turns to the angle, which nothing here depends on.
NcResult<void> orientation(Channel& channel, Words words) {
  const auto angle = TRY(value(channel, words, Letter::Value, 0));
  if (std::abs(angle) > 360) return nc_error(1013, "cycle 13: {} degrees", angle);
  return {};
}

NcResult<void> dwell(Channel& channel, Words words) {
  return channel.machine().dwell(TRY(value(channel, words, Letter::Value, 0)));
}

/// Exactly the named axes are mirrored. @errors for other axes than X, Y and Z.
NcResult<void> mirror(Channel& channel, Words words) {
  std::array<bool, 3> axes{};
  for (const Word& word : words) {
    if (word.letter > Letter::Z)
      return nc_error("only X, Y and Z are mirrored here, not {}", klartext::spelling(word.letter));
    axes[static_cast<std::size_t>(word.letter)] = true;
  }
  return change_frames(channel, [&](Frames& frames) { frames.set_mirror(axes); });
}

NcResult<void> rotation(Channel& channel, Words words) {
  const auto angle = TRY(value(channel, words, Letter::Rot, 0));
  const Word* word = find(words, Letter::Rot);
  const Axis tool_axis = channel.state().tool_axis();
  return change_frames(channel, [&](Frames& frames) {
    const bool is_added = word != nullptr && word->incremental;
    const double last = is_added ? frames.rotation().angle_deg : 0;
    frames.set_rotation({last + angle, tool_axis});
  });
}

/// @errors 1011 a factor that is not positive.
NcResult<void> scale(Channel& channel, const machine::Scaling& scaling) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (scaling.factor[axis] <= 0) return nc_error(1011, "scaling factor {}", scaling.factor[axis]);
  }
  return change_frames(channel, [&](Frames& frames) { frames.set_scaling(scaling); });
}

NcResult<void> scaling(Channel& channel, Words words) {
  const auto factor = TRY(value(channel, words, Letter::Scl, 1));
  return scale(channel, {{factor, factor, factor}, {}});
}

NcResult<void> axis_scaling(Channel& channel, Words words) {
  machine::Scaling scaling;
  constexpr std::array kFactors{Letter::X, Letter::Y, Letter::Z};
  constexpr std::array kCentres{Letter::Ccx, Letter::Ccy, Letter::Ccz};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto factor = TRY(value(channel, words, kFactors[axis], 1));
    const auto centre = TRY(value(channel, words, kCentres[axis], 0));
    scaling.factor[axis] = factor;
    scaling.centre[axis] = centre * channel.length_unit();
  }
  return scale(channel, scaling);
}

NcResult<void> working_plane_cycle(Channel& channel, Words words) {
  const auto axes = TRY(read_axis_words(channel, words));
  Vec3 angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& word = axes[i + 3];
    if (word && word->incremental)
      return nc_error("cycle 19 takes no I: write the angles themselves");
    if (word) angles[i] = word->value;
  }
  if (find(words, Letter::F) != nullptr || find(words, Letter::Value) != nullptr)
    TRY(channel.note("cycle 19: F and ABST have no effect, because the program turns the axes"));
  if (angles == Vec3{}) return reset_tilt(channel, {});
  return tilt(channel, Matrix3::spatial(angles), {});
}

NcResult<void> program_call(Channel& channel, Words words) {
  const Word* path = find(words, Letter::Program);
  if (path == nullptr) return nc_error(1017, "CYCL DEF 12 needs a program");
  const auto written = TRY(text(channel, path->value));
  channel.active_cycle.definition = TRY(channel.resolve_program(written));
  channel.active_cycle.number = 12;
  return {};
}

}  // namespace

NcResult<void> shift_datum_to_row(Channel& channel, std::int64_t row) {
  AxisCoordinates axes;
  for (const Axis axis : kAllAxes) {
    const auto value = TRY(channel.tables.datum(row, axis));
    if (value) axes[index(axis)] = Coordinate{*value, false};
  }
  return shift_datum(channel, axes);
}

NcResult<void> reset_datum_shift(Channel& channel) {
  return change_frames(channel, [](Frames& frames) { frames.set_datum_shift({}); });
}

NcResult<void> tilt(Channel& channel, const Matrix3& rotation, const PlaneMoves& moves) {
  Frames frames = channel.state().frames;
  Position shift = untilted_shift(frames);
  frames.set_plane(machine::TiltedPlane{machine::spatial_angles(rotation), shift.linear});
  shift.linear = {};
  frames.set_datum_shift(shift);
  const auto rotary = TRY(rotary_positions(channel, frames, moves));
  return apply(channel, frames, rotary, moves);
}

NcResult<void> reset_tilt(Channel& channel, const PlaneMoves& moves) {
  Frames frames = channel.state().frames;
  const Position shift = untilted_shift(frames);
  frames.set_plane(std::nullopt);
  frames.set_datum_shift(shift);
  const Vec3 home = frames.rotary_to_machine({}, CoordinateSystem::Workpiece);
  return apply(channel, frames, home, moves);
}

NcResult<void> execute_transformation(Channel& channel, int cycle, Words words) {
  switch (cycle) {
    case 7: return datum_shift(channel, words);
    case 8: return mirror(channel, words);
    case 9: return dwell(channel, words);
    case 10: return rotation(channel, words);
    case 11: return scaling(channel, words);
    case 12: return program_call(channel, words);
    case 19: return working_plane_cycle(channel, words);
    case 26: return axis_scaling(channel, words);
    case 13: return orientation(channel, words);
    default: return tolerance(channel, words);
  }
}

}  // namespace fitgauge::interpreter
