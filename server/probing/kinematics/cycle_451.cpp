#include <array>

#include "probing/cycles.hpp"
#include "probing/kinematics/log.hpp"
#include "probing/kinematics/parameters.hpp"
#include "probing/kinematics/preset.hpp"

namespace fitgauge::probing {
namespace {

using namespace parameter;

constexpr std::array kMode{choice(
    406, "Mode: 0 check, 1 optimise locations, 2 optimise locations and directions", 0, 2, 0)};
constexpr std::array kEnd{kTouchesOfSphere, kPresetAtSphere, kBacklashAngle};
constexpr auto kParameters = join(join(kMode, kSphereApproach), join(kRotaryAxes, kEnd));

constexpr std::array<std::string_view, 3> kModes{"0 = check", "1 = optimise locations",
                                                 "2 = optimise locations and directions"};

/// The error of the axis that was measured last.
Vec3 offset_error(const KinematicsMeasurement& measurement) {
  if (measurement.axes.empty()) return {};
  return measurement.axes.back().errors.location.value_or(Vec3{});
}

CycleResult<void> measure(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const int mode = arguments.whole(406);
  const PresetAtSphere preset(arguments.whole(431));
  const auto plans = plan_positions(arguments, context.machine.state());
  if (!plans) return plans.error();
  if (auto writable = preset.check(context); !writable) return writable;
  auto probing = KinematicsProbing::begin(context);
  if (!probing) return probing.error();
  if (auto set = preset.before(context, *probing); !set) return set;

  const auto measurement = measure_kinematics(context, *probing, *plans, mode != 1);
  if (!measurement) return measurement.error();
  if (mode != 0) {
    if (auto set = lift(context.machine.set_kinematics(measurement->corrected)); !set) return set;
  }
  write_kinematics_results(context.host, *measurement, offset_error(*measurement));
  const KinematicsReport report{.mode = kModes.at(static_cast<std::size_t>(mode)),
                                .measurement = *measurement,
                                .directions = mode != 1};
  if (auto logged = log_kinematics(context, report); !logged) return logged;
  return preset.after(context, *probing);
}

}  // namespace

constinit const TouchProbeCycle kCycle451{
    {.number = 451,
     .name = "MEASURE KINEMATICS",
     .kind = CycleKind::Kinematics,
     .parameters = kParameters,
     .results = kKinematicsResults,
     .simulated =
         "All parameters, against the calibration_sphere of the setup. Q406 = 1 corrects the "
         "location of each measured axis in the kinematic model, 2 its direction too; 0 says what "
         "2 "
         "would correct. Q408 = 0 needs TCPM: the probe then circles the sphere. A reference is "
         "measured at 0 degrees of each axis. Q141 to Q146 with one position beside it hold the "
         "error of that position. Q147 to Q149 are the location error of the axis measured last, "
         "real minus modelled. What the positions cannot see is not corrected, and the log says "
         "so; nor can they tell what an axis below has come to rest with from a location error. "
         "The "
         "axes end at 0. Backlash is measured, never compensated. The log "
         "TCHPR451.html.",
     .not_simulated =
         "Positioning by an M function (mStrobeRotAxPos). The largest permitted correction "
         "(maxModification)."},
    measure};

}  // namespace fitgauge::probing
