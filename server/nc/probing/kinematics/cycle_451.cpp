#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/kinematics/correction.hpp"
#include "nc/probing/kinematics/log.hpp"
#include "nc/probing/kinematics/parameters.hpp"

namespace fitgauge::probing::cycle_451 {

using namespace parameter;

constexpr std::array kMode{choice(
    406, "Mode: 0 check, 1 optimise locations, 2 optimise locations and directions, 3 zeros too", 0,
    3, 0)};
constexpr std::array kEnd{kTouchesOfSphere, kPresetAtSphere, kBacklashAngle};
constexpr auto kParameters = join(join(kMode, kSphereApproach), join(kRotaryAxes, kEnd));

constexpr std::array<std::string_view, 4> kModes{"0 = check", "1 = optimise locations",
                                                 "2 = optimise locations and directions",
                                                 "3 = optimise zeros, locations and directions"};

/// The error of the axis that was measured last.
Vec3 offset_error(const KinematicsMeasurement& measurement) {
  if (measurement.axes.empty()) return {};
  const auto& location = measurement.axes.back().errors.location;
  return location ? location->value : Vec3{};
}

CycleResult<void> measure(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const int mode = arguments.whole(406);
  const PresetAtSphere preset(arguments.whole(431));
  const auto plans = TRY(plan_positions(arguments, context.machine.state()));
  TRY(preset.check(context));
  auto probing = TRY(KinematicsProbing::begin(context));
  TRY(preset.before(context, probing));

  FitOptions options = fit_options(context, mode != 1);
  options.zeros = mode == 3;
  const auto measurement = TRY(measure_kinematics(context, probing, plans, options));
  write_kinematics_results(context.host, measurement, offset_error(measurement));
  const KinematicsReport report{.mode = kModes.at(static_cast<std::size_t>(mode)),
                                .measurement = measurement,
                                .directions = mode != 1};
  TRY(log_kinematics(context, report));
  if (mode != 0) {
    std::vector<AxisErrors> errors;
    for (const AxisMeasurement& axis : measurement.axes) errors.push_back(axis.errors);
    TRY(correct_kinematics(context, errors, measurement.is_corrected, measurement.corrected));
  }
  return preset.after(context, probing);
}

constinit const TouchProbeCycle kCycle451 = cycle(
    451, "MEASURE KINEMATICS", CycleKind::Kinematics, kParameters, kKinematicsResults,
    errors::kTouching | errors::kKinematics | ErrorSet{1005, 1085}, measure,
    "All parameters, against the calibration_sphere of the setup. All measured axes are "
    "fitted together, the others standing at their incidence. Q406 = 1 corrects the location "
    "of each measured axis in the kinematic model, 2 its direction too; 0 says what 2 would "
    "correct. 3 corrects the zeros besides: what a measured axis is tilted by around the "
    "measured axis that carries it is that axis' zero (a C that leans around A shows where A "
    "0 really stands), and the preset is to be set anew (Q431). The zero of the axis next to "
    "the sphere or to the tool shows in no position: it belongs to the preset or to the "
    "probe. "
    "An error below twice its uncertainty is not corrected: 1102 when nothing is "
    "left to correct, or a note with insignificant_corrections of the setup. Beyond its "
    "max_modification_mm the cycle stops for NC Start before it corrects. Q408 = 0 needs the "
    "option of TCPM (tcpm_option): the probe then circles the sphere. A reference is measured "
    "at 0 degrees of each axis. Q141 to Q146 are the root mean square of the errors in space, "
    "with one position beside the reference its error; Q144 to Q146 are what the next check "
    "finds. Q147 to Q149 are the location error of the axis measured last, real minus "
    "modelled. What the positions cannot see is not corrected, and the log says so; nor can "
    "they tell what another axis has come to rest with from a location error. The axes end at "
    "0. An axis of strobe_rotary_axes stands at 0 before the start, gets its targets in Q120 "
    "to Q122 for its M function and has no backlash measured. Backlash is measured, never "
    "compensated. The log TCHPR451.html.");

}  // namespace fitgauge::probing::cycle_451
