#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/kinematics/log.hpp"
#include "nc/probing/kinematics/parameters.hpp"
#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing::cycle_452 {

using namespace parameter;
using machine::Kinematics;
using machine::RotaryAxis;

constexpr std::array kEnd{kTouchesOfSphere, kBacklashAngle};
constexpr auto kParameters = join(kSphereApproach, join(kRotaryAxes, kEnd));

/// Returns the place of the sphere by the corrected model with all axes at zero: the mean of the
/// axes.
Vec3 place_of_sphere(const KinematicsMeasurement& measurement, const MeasuringTool& tool) {
  Vec3 sum;
  for (const AxisMeasurement& axis : measurement.axes) {
    sum = sum + spread(axis.poses, measurement.corrected, tool).centre;
  }
  return sum * (1 / static_cast<double>(measurement.axes.size()));
}

/// Returns the machine as seen from a tool that is `shift` further. Places on the bed do not move
/// with it.
Kinematics compensated(const Kinematics& model, const Vec3& shift) {
  std::vector<RotaryAxis> axes = model.axes();
  for (RotaryAxis& axis : axes) {
    if (axis.mount == machine::AxisMount::Table) axis.centre = axis.centre - shift;
  }
  return Kinematics(std::move(axes), model.offset() - shift);
}

CycleResult<void> check_complete(const KinematicsMeasurement& measurement) {
  if (measurement.axes.empty()) return nc_error(1102, "no axis is to be measured");
  for (const AxisMeasurement& axis : measurement.axes) {
    if (axis.errors.location) continue;
    return nc_error(
        1102,
        std::string("the positions cannot see the location of axis ").append(name(axis.plan.axis)));
  }
  return {};
}

CycleResult<void> compensate(const CycleContext& context) {
  const auto plans = TRY(plan_positions(context.arguments, context.machine.state()));
  auto probing = TRY(KinematicsProbing::begin(context));
  const Vec3 preset = probing.sphere();
  const auto measurement = TRY(measure_kinematics(context, probing, plans, {.directions = false}));
  TRY(check_complete(measurement));

  const Vec3 shift = place_of_sphere(measurement, probing.tool()) - preset;
  const Kinematics model = compensated(measurement.corrected, shift);
  TRY(lift(context.machine.set_kinematics(model)));
  write_kinematics_results(context.host, measurement, shift);
  const KinematicsReport report{.mode = "preset compensation",
                                .measurement = measurement,
                                .directions = false,
                                .shift = shift};
  TRY(log_kinematics(context, report));
  TRY(probing.turn({}));
  return probing.retract();
}

constinit const TouchProbeCycle kCycle452 =
    cycle(452, "PRESET COMPENSATION", CycleKind::Kinematics, kParameters, kKinematicsResults,
          errors::kTouching | errors::kKinematics | ErrorSet{1005}, compensate,
          "All parameters. Measures as 451 and corrects the location of each measured axis; then "
          "the kinematic model is shifted so that the active preset, which keeps its values, lies "
          "in the centre of the sphere: for a head that was exchanged, and for drift. Q147 to Q149 "
          "are that shift. The log TCHPR452.html.");

}  // namespace fitgauge::probing::cycle_452
