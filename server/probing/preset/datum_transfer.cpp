#include "probing/preset/datum_transfer.hpp"

#include "probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using machine::AxisWords;
using machine::CoordinateSystem;
using machine::Matrix3;
using machine::Preset;
using machine::PresetFrame;

Vec3 rounded(const Vec3& point) {
  return {to_length(point.x).to_mm(), to_length(point.y).to_mm(), to_length(point.z).to_mm()};
}

/// A DatumPoint by machine axes, its point relative to the machine zero of presets.
struct MachineDatum {
  Vec3 point;
  std::array<bool, 3> axes{};
  Vec3 datum;
};

MachineDatum in_machine(const machine::Frames& frames, const WorkingPlane& plane,
                        const DatumPoint& found) {
  const PresetFrame& active = frames.preset();
  const Vec3 workpiece = frames.from_machine(frames.to_machine(plane.to_input(found.point)),
                                             CoordinateSystem::Workpiece);
  MachineDatum made{
      .point = active.origin + Matrix3::spatial(active.basic_rotation_deg) * workpiece,
      .datum = plane.to_input(found.datum)};
  made.axes[index(plane.main)] = found.axes[0];
  made.axes[index(plane.secondary)] = found.axes[1];
  made.axes[index(plane.probe)] = found.axes[2];
  return made;
}

/// Moves the zero of a preset so that the point reads `datum` in the named axes; the other axes
/// keep their zero.
void move_zero(PresetFrame& frame, const MachineDatum& found) {
  const Matrix3 rotation = Matrix3::spatial(frame.basic_rotation_deg);
  const Vec3 point = rotation.transposed() * found.point;
  Vec3 zero = rotation.transposed() * frame.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (found.axes[axis]) zero[axis] = point[axis] - found.datum[axis];
  }
  frame.origin = rounded(rotation * zero);
}

CycleResult<void> write_preset(const CycleContext& context, const PresetFrame& turned,
                               std::span<const MachineDatum> points) {
  const machine::MachineState& state = context.machine.state();
  const int number = context.arguments.whole(305);
  Preset row{.number = number, .comment = {}, .frame = turned};
  const Preset* existing = number == 0 ? nullptr : state.presets.find(number);
  if (existing != nullptr) {
    row = *existing;
    if (turned != state.frames.preset()) {
      row.frame.basic_rotation_deg = turned.basic_rotation_deg;
    }
  }
  for (const MachineDatum& point : points) move_zero(row.frame, point);
  if (auto written = lift(context.machine.write_preset(row)); !written) return written;
  if (number != 0) return {};
  return lift(context.machine.activate_preset(0));
}

CycleResult<void> write_datum_table(const CycleContext& context, const PresetFrame& turned,
                                    std::span<const MachineDatum> points) {
  AxisWords values;
  const Matrix3 inverse = Matrix3::spatial(turned.basic_rotation_deg).transposed();
  for (const MachineDatum& found : points) {
    const Vec3 datum = rounded(inverse * (found.point - turned.origin) - found.datum);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (found.axes[axis]) values.values[axis] = datum[axis];
    }
  }
  if (auto written = context.host.write_datum(context.arguments.whole(305), values); !written) {
    return written;
  }
  machine::Frames frames = context.machine.state().frames;
  if (turned == frames.preset()) return {};
  frames.set_preset(turned);
  return lift(context.machine.set_frames(frames));
}

}  // namespace

CycleResult<ProbingMotion> begin_preset(const CycleContext& context) {
  if (auto allowed = refuse_mirror_and_scaling(context.machine.state().frames); !allowed) {
    return allowed.error();
  }
  if (context.arguments.whole(303) == -1 && context.arguments.whole(305) != 0) {
    return nc_error(1078, "0 is the datum table, 1 the preset table");
  }
  return ProbingMotion::begin(context);
}

CycleResult<void> transfer_datum(const CycleContext& context, const WorkingPlane& plane,
                                 std::span<const DatumPoint> points,
                                 std::optional<double> turn_deg) {
  const machine::Frames& frames = context.machine.state().frames;
  std::vector<MachineDatum> found;
  for (const DatumPoint& point : points) found.push_back(in_machine(frames, plane, point));
  PresetFrame turned = frames.preset();
  turned.basic_rotation_deg[index(plane.probe)] += to_angle(turn_deg.value_or(0));
  const bool datum_table = context.arguments.whole(303) == 0 && context.arguments.whole(305) != 0;
  return datum_table ? write_datum_table(context, turned, found)
                     : write_preset(context, turned, found);
}

}  // namespace fitgauge::probing
