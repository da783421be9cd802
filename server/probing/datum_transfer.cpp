#include "probing/datum_transfer.hpp"

#include "probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using machine::AxisWords;
using machine::CoordinateSystem;
using machine::Matrix3;
using machine::Preset;
using machine::PresetFrame;

Vec3 workpiece_coordinates(const machine::Frames& frames, const Vec3& input) {
  return frames.from_machine(frames.to_machine(input), CoordinateSystem::Workpiece);
}

/// Moves the zero of a preset so that a point given in coordinates of the active one reads `datum`
/// in the named axes of the moved one; the other axes keep their zero.
PresetFrame moved(PresetFrame row, const PresetFrame& active, const Vec3& point,
                  const std::array<bool, 3>& axes, const Vec3& datum) {
  const Matrix3 rotation = Matrix3::spatial(row.basic_rotation_deg);
  const Matrix3 inverse = rotation.transposed();
  const Vec3 machine_point = active.origin + Matrix3::spatial(active.basic_rotation_deg) * point;
  const Vec3 along_axes = inverse * machine_point;
  Vec3 zero = inverse * row.origin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axes[axis]) zero[axis] = along_axes[axis] - datum[axis];
  }
  row.origin = rotation * zero;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    row.origin[axis] = to_length(row.origin[axis]).to_mm();
  }
  return row;
}

/// A DatumPoint in workpiece coordinates and by machine axes.
struct WorkpieceDatum {
  Vec3 point;
  std::array<bool, 3> axes{};
  Vec3 datum;
};

WorkpieceDatum in_workpiece(const machine::Frames& frames, const WorkingPlane& plane,
                            const DatumPoint& point) {
  WorkpieceDatum made{.point = workpiece_coordinates(frames, plane.to_input(point.point)),
                      .datum = plane.to_input(point.datum)};
  made.axes[index(plane.main)] = point.axes[0];
  made.axes[index(plane.secondary)] = point.axes[1];
  made.axes[index(plane.probe)] = point.axes[2];
  return made;
}

CycleResult<void> write_preset(const CycleContext& context,
                               std::span<const WorkpieceDatum> points) {
  const machine::MachineState& state = context.machine.state();
  const int number = context.arguments.whole(305);
  const PresetFrame active = state.frames.preset();
  Preset row{.number = number, .comment = {}, .frame = active};
  const Preset* existing = number == 0 ? nullptr : state.presets.find(number);
  if (existing != nullptr) row = *existing;
  for (const WorkpieceDatum& point : points) {
    row.frame = moved(row.frame, active, point.point, point.axes, point.datum);
  }
  if (auto written = lift(context.machine.write_preset(row)); !written) return written;
  if (number != 0) return {};
  return lift(context.machine.activate_preset(0));
}

CycleResult<void> write_datum_table(const CycleContext& context,
                                    std::span<const WorkpieceDatum> points) {
  AxisWords values;
  for (const WorkpieceDatum& point : points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!point.axes[axis]) continue;
      values.values[axis] = to_length(point.point[axis] - point.datum[axis]).to_mm();
    }
  }
  return context.host.write_datum(context.arguments.whole(305), values);
}

}  // namespace

CycleResult<void> prepare_preset(const CycleContext& context) {
  const machine::Frames& frames = context.machine.state().frames;
  if (frames.is_mirrored()) return nc_error(1008, "reset cycle 8 before setting a datum");
  if (frames.is_scaled()) return nc_error(1007, "reset cycles 11 and 26 before setting a datum");
  if (context.arguments.whole(303) == -1 && context.arguments.whole(305) != 0) {
    return nc_error(1078, "0 is the datum table, 1 the preset table");
  }
  return {};
}

CycleResult<void> transfer_datum(const CycleContext& context, const WorkingPlane& plane,
                                 std::span<const DatumPoint> points) {
  std::vector<WorkpieceDatum> by_axes;
  for (const DatumPoint& point : points) {
    by_axes.push_back(in_workpiece(context.machine.state().frames, plane, point));
  }
  const bool datum_table = context.arguments.whole(303) == 0 && context.arguments.whole(305) != 0;
  return datum_table ? write_datum_table(context, by_axes) : write_preset(context, by_axes);
}

}  // namespace fitgauge::probing
