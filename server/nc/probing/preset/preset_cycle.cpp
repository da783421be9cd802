#include "nc/probing/preset/preset_cycle.hpp"

#include "nc/probing/alignment/rotation.hpp"

namespace fitgauge::probing {
namespace {

using machine::AxisWords;
using machine::CoordinateSystem;
using machine::Frames;
using machine::Matrix3;
using machine::Preset;
using machine::PresetFrame;

/// Rounds to 1e-9 mm, without the noise of the arithmetic. Whole nanometres are too coarse: a
/// tilted axis adds the rounding of three machine axes.
Vec3 tidy(Vec3 point) {
  constexpr double kPicometres = 1e9;  // in a mm
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = std::round(point[axis] * kPicometres) / kPicometres;
  return point;
}

/// A point of the plane in the machine's axes, with its place in the Basic coordinates of presets.
DatumPoint basic_of(const Frames& frames, const WorkingPlane& plane, const DatumPoint& found) {
  DatumPoint made{.point = frames.from_machine(frames.to_machine(plane.to_input(found.point)),
                                               CoordinateSystem::Basic),
                  .datum = plane.to_input(found.datum)};
  made.axes[index(plane.main)] = found.axes[0];
  made.axes[index(plane.secondary)] = found.axes[1];
  made.axes[index(plane.probe)] = found.axes[2];
  return made;
}

/// Returns the axes along which a datum is set: the axes of the workpiece with that basic rotation,
/// or of the plane that is tilted in it (decision 25).
Matrix3 axes_of(const Frames& frames, const PresetFrame& preset) {
  return Matrix3::spatial(preset.basic_rotation_deg) * tilt_of(frames);
}

/// Moves the zero of a preset along `axes` until the point has the coordinate `datum` in the named
/// axes. Activating the row (247, Q305 = 0) leaves only the tilt.
void move_zero(PresetFrame& preset, const Matrix3& axes, const DatumPoint& found) {
  const Vec3 reading = axes.transposed() * (found.point - preset.origin);
  Vec3 way;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (found.axes[axis]) way[axis] = reading[axis] - found.datum[axis];
  }
  preset.origin = tidy(preset.origin + axes * way);
}

CycleResult<void> write_preset(const CycleContext& context, const PresetFrame& turned,
                               std::span<const DatumPoint> points) {
  const machine::MachineState& state = context.state();
  const int number = context.whole(305);
  Preset row{.number = number, .comment = {}, .frame = turned};
  const Preset* existing = number == 0 ? nullptr : state.presets.find(number);
  if (existing != nullptr) {
    row = *existing;
    if (turned != state.frames.preset()) row.frame.basic_rotation_deg = turned.basic_rotation_deg;
  }
  const Matrix3 axes = axes_of(state.frames, row.frame);
  for (const DatumPoint& point : points) move_zero(row.frame, axes, point);
  TRY(context.machine.write_preset(row));
  if (number != 0) return {};
  return context.machine.activate_preset(0);
}

CycleResult<void> write_datum_table(const CycleContext& context, const PresetFrame& turned,
                                    std::span<const DatumPoint> points) {
  const Frames& frames = context.state().frames;
  const Matrix3 inverse = axes_of(frames, turned).transposed();
  // A shift of cycle 7 counts from the origin of the tilting.
  const Vec3 tilted_at = frames.plane() ? frames.plane()->origin : Vec3{};
  const Vec3 zero = turned.origin + Matrix3::spatial(turned.basic_rotation_deg) * tilted_at;
  AxisWords values;
  for (const DatumPoint& found : points) {
    const Vec3 datum = tidy(inverse * (found.point - zero) - found.datum);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (found.axes[axis]) values.values[axis] = datum[axis];
    }
  }
  TRY(context.host.write_datum(context.whole(305), values));
  return turned == frames.preset() ? CycleResult<void>()
                                   : replace_active_preset(context.machine, turned);
}

/// Writes the datum as Q303 and Q305 say. Q305 = 0: row 0 of the preset table becomes the active
/// preset with the new datum. Otherwise it is only stored: with Q303 = 1 in that row of the preset
/// table (a row that does not exist yet begins as the active one), with Q303 = 0 in that row of the
/// active datum table, relative to the active preset. Axes that are not named keep their value.
/// The zero moves along the axes of a tilted plane, so that the point reads the datum there
/// (decision 25). `turn_deg` is the angle of the part to the main axis: the basic rotation turns by
/// it around the probe axis; a datum table has none, so there the active preset turns at once.
/// @errors 1043 no datum table is active, 1085 the row is write-protected.
CycleResult<void> transfer_datum(const CycleContext& context, const WorkingPlane& plane,
                                 std::span<const DatumPoint> points,
                                 std::optional<double> turn_deg = std::nullopt) {
  const machine::Frames& frames = context.state().frames;
  std::vector<DatumPoint> found;
  for (const DatumPoint& point : points) found.push_back(basic_of(frames, plane, point));
  PresetFrame turned = frames.preset();
  if (turn_deg) turned.basic_rotation_deg = turned_rotation(frames, plane, *turn_deg);
  const bool datum_table = context.whole(303) == 0 && context.whole(305) != 0;
  return datum_table ? write_datum_table(context, turned, found)
                     : write_preset(context, turned, found);
}

}  // namespace

void publish_circle(const CycleContext& context, Side side, const ProbedCircle& probed) {
  const Circle& circle = probed.circle;
  CycleHost& host = context.host;
  set_lengths(host, 151, {circle.centre.x, circle.centre.y, 2 * circle.radius});
  host.record({.cycle = context.descriptor().number,
               .sizes = {{.characteristic = "Diameter",
                          .role = size_role(side),
                          .nominal = to_length(context.number(262)),
                          .measured = to_length(2 * circle.radius)}},
               .form = probed.form});
}

CycleResult<void> check_transfer(const Arguments& arguments) {
  const auto value = [&](int parameter, double unknown) {
    return arguments.has_number(q(parameter)) ? arguments.number(parameter) : unknown;
  };
  const bool transfers = arguments.descriptor().find(q(337)) == nullptr || value(337, 0) == 1;
  if (!transfers || value(303, 1) != -1 || value(305, 0) == 0) return {};
  return nc_error(1078, "0 is the datum table, 1 the preset table");
}

CycleResult<ProbingMotion> begin_preset(const CycleContext& context) {
  TRY(refuse_mirror_and_scaling(context.state().frames));
  TRY(check_transfer(context));
  return ProbingMotion::begin(context);
}

CycleResult<void> correct_preset(const CycleContext& context, const WorkingPlane& plane,
                                 PresetFrame turned, const std::optional<MovedPoint>& moved) {
  const machine::MachineState& state = context.state();
  const Frames& frames = state.frames;
  const PresetFrame before = frames.preset();
  if (moved) {
    DatumPoint found =
        basic_of(frames, plane, {.point = moved->measured, .axes = {true, true, true}});
    const Vec3 nominal = basic_of(frames, plane, {.point = moved->nominal}).point;
    found.datum = axes_of(frames, before).transposed() * (nominal - before.origin);
    move_zero(turned, axes_of(frames, turned), found);
  }
  if (turned == before) return {};
  Preset row = state.preset_row(state.active_preset);
  row.frame.origin = tidy(row.frame.origin + turned.origin - before.origin);
  row.frame.basic_rotation_deg = turned.basic_rotation_deg;
  row.frame.rotary_offsets_deg = turned.rotary_offsets_deg;
  TRY(context.machine.write_preset(row));
  return replace_active_preset(context.machine, turned);
}

DatumPoint plane_datum(const Arguments& arguments, const Vec3& point) {
  return {.point = {point.x, point.y, arguments.number(261)},
          .axes = {true, true, false},
          .datum = {arguments.number(331), arguments.number(332), 0}};
}

CycleResult<void> finish_preset(const CycleContext& context, ProbingMotion& motion,
                                const DatumPoint& found, std::optional<double> basic_rotation) {
  std::vector<DatumPoint> points{found};
  if (context.whole(381) == 1) {
    const Vec3 nominal = place_of(context, 382, 383, 384);
    const auto surface = TRY(touch_down(context, motion, nominal));
    points.push_back(
        {.point = surface, .axes = {false, false, true}, .datum = {0, 0, context.number(333)}});
  }
  return transfer_datum(context, motion.plane(), points, basic_rotation);
}

CycleResult<void> set_datum_of_axis(const CycleContext& context, const WorkingPlane& plane,
                                    const Vec3& surface, std::size_t axis) {
  set_lengths(context.host, 160, {surface[axis]});
  DatumPoint found{.point = surface};
  found.axes[axis] = true;
  found.datum[axis] = context.number(333);
  return transfer_datum(context, plane, std::array{found});
}

}  // namespace fitgauge::probing
