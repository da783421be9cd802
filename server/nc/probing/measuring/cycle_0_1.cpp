#include "nc/probing/cycles.hpp"
#include "nc/probing/dotted_parameters.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/measured_value.hpp"
#include "nc/probing/measuring/measurement.hpp"

namespace fitgauge::probing::cycle_0_1 {

using namespace parameter;

constexpr std::array k0Parameters{result_parameter(0),
                                  in_part(0, kWordAxis),
                                  in_part(0, kWordDirection),
                                  pre_position(1, ParameterId::WordX),
                                  pre_position(1, ParameterId::WordY),
                                  pre_position(1, ParameterId::WordZ)};

constexpr std::array k1Parameters{
    in_part(1, kWordAxis), in_part(1, kWordAngle), pre_position(2, ParameterId::WordX),
    pre_position(2, ParameterId::WordY), pre_position(2, ParameterId::WordZ)};

/// Moves the tip in all axes at once to the position in the block, then touches and returns.
CycleResult<Contact> touch_from_position(const CycleContext& context, const Vec3& direction) {
  auto motion = TRY(begin_measurement(context));
  machine::AxisWords position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto id = static_cast<ParameterId>(static_cast<std::size_t>(ParameterId::WordX) + axis);
    if (context.arguments.has_number(id)) position.values[axis] = context.arguments.number(id);
  }
  TRY(motion.move_tip(position));
  return motion.probe(motion.plane().from_input(direction));
}

CycleResult<void> reference_plane(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const double sign = arguments.number(ParameterId::WordDirection);
  if (sign == 0) return nc_error(1042, "the sign of the probing direction is missing");
  const auto axis = static_cast<machine::Axis>(arguments.number(ParameterId::WordAxis));
  const auto contact = TRY(touch_from_position(context, unit_vector(axis) * sign));
  const WorkingPlane plane = WorkingPlane::across(context.machine.state().tool_axis());
  const double coordinate = plane.to_input(contact.surface)[index(axis)];
  set_length(context.host, static_cast<std::uint16_t>(arguments.number(ParameterId::WordResult)),
             coordinate);
  return {};
}

CycleResult<void> polar(const CycleContext& context) {
  TRY(touch_from_position(context, angled_direction(context.arguments)));
  return {};
}

constinit const TouchProbeCycle kCycle0 =
    cycle(0, "REF. PLANE", CycleKind::Measuring, k0Parameters, kTouchResults,
          errors::kMeasuring | ErrorSet{1042}, reference_plane,
          "All parameters. The position is that of the tip; the result is compensated.");

constinit const TouchProbeCycle kCycle1 = cycle(
    1, "POLAR DATUM", CycleKind::Measuring, k1Parameters, kTouchResults, errors::kMeasuring, polar,
    "All parameters. The position is that of the tip; the angle turns from the named "
    "axis to the next one (X to Y, Y to Z, Z to X).");

}  // namespace fitgauge::probing::cycle_0_1
