#include "nc/probing/cycles.hpp"
#include "nc/probing/errors.hpp"
#include "nc/probing/kinematics/correction.hpp"
#include "nc/probing/kinematics/log.hpp"
#include "nc/probing/kinematics/parameters.hpp"
#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing::cycle_453 {

using namespace parameter;
using machine::Axis;

constexpr std::array kMode{choice(406, "Mode: -1 delete, 0 check, 1 optimise", -1, 1, 0)};
constexpr std::array kEnd{kTouchesOfSphere, kPresetAtSphere};
constexpr auto kParameters = join(join(kMode, kSphereApproach), kEnd);

constexpr std::array<CycleOutput, 6> kResults{
    {{141, "Measured standard deviation of A, mm; -1 no such axis", Unit::None},
     {142, "Measured standard deviation of B, mm; -1 no such axis", Unit::None},
     {143, "Measured standard deviation of C, mm; -1 no such axis", Unit::None},
     {144, "Optimised standard deviation of A, mm; -1 no such axis", Unit::None},
     {145, "Optimised standard deviation of B, mm; -1 no such axis", Unit::None},
     {146, "Optimised standard deviation of C, mm; -1 no such axis", Unit::None}}};

/// Defaults in place of a machine builder's: five positions over the range of the axis, at most
/// half a turn to either side.
std::vector<double> positions_of(const machine::AxisRange& range) {
  constexpr double kHalfTurn = 180;
  return measuring_positions(std::max(range.min, -kHalfTurn), std::min(range.max, kHalfTurn), 5,
                             range.hirth_grid_deg);
}

struct Grid {
  std::vector<Axis> axes;
  std::vector<Vec3> positions{Vec3{}};  ///< every combination
};

/// @errors 1100 the machine has no rotary axis.
CycleResult<Grid> grid_of(const machine::MachineState& state) {
  Grid grid;
  for (const machine::RotaryAxis& axis : state.kinematics.axes()) {
    grid.axes.push_back(axis.axis);
    std::vector<Vec3> combined;
    for (const Vec3& others : grid.positions) {
      for (const double position : positions_of(*state.ranges[index(axis.axis)])) {
        combined.push_back(others);
        combined.back()[index(axis.axis) - 3] = position;
      }
    }
    grid.positions = std::move(combined);
  }
  if (grid.axes.empty()) return nc_error(1100, "the machine has no rotary axis");
  return grid;
}

void write_results(CycleHost& host, const Grid& grid, const KinematicsFit& fit) {
  for (std::uint16_t letter = 0; letter < 3; ++letter) {
    const auto axis = static_cast<Axis>(letter + 3);
    const bool measured = std::ranges::find(grid.axes, axis) != grid.axes.end();
    const auto set = [&](int first, double value) {
      host.set_q(static_cast<std::uint16_t>(first + letter),
                 measured ? to_length(value).to_mm() : -1, Unit::None);
    };
    set(141, fit.before.front().deviation);
    set(144, fit.after.front().deviation);
  }
}

CycleResult<void> measure_grid(const CycleContext& context) {
  const Arguments& arguments = context.arguments;
  const int mode = arguments.whole(406);
  const PresetAtSphere preset(arguments.whole(431));
  if (mode == -1) {
    return nc_error(1097, "corrections go into the kinematic model: restore a record of cycle 450");
  }
  const auto grid = TRY(grid_of(context.machine.state()));
  TRY(preset.check(context));
  auto probing = TRY(KinematicsProbing::begin(context));
  TRY(preset.before(context, probing));

  PoseGroup poses;
  for (const Vec3& position : grid.positions) {
    const auto pose = TRY(probing.measure(position));
    poses.push_back(pose);
  }
  const KinematicsFit fit = fit_kinematics(std::array{poses}, context.machine.state().kinematics,
                                           probing.tool(), grid.axes, fit_options(context, true));
  write_results(context.host, grid, fit);
  const std::string_view words = mode == 1 ? "1 = optimise" : "0 = check";
  TRY(log_grid(context, words, poses, fit));
  if (mode == 1) TRY(correct_kinematics(context, fit.errors, fit.is_corrected, fit.corrected));
  return preset.after(context, probing);
}

constinit const TouchProbeCycle kCycle453 =
    cycle(453, "KINEMATICS GRID", CycleKind::Kinematics, kParameters, kResults,
          errors::kTouching | errors::kKinematics | ErrorSet{1085, 1097}, measure_grid,
          "Measures the calibration_sphere of the setup at every combination of five positions of "
          "each rotary axis, evenly over its range but at most half a turn to either side, and "
          "finds location and direction of all axes together; Q406 = 1 corrects them in the "
          "kinematic model. All axes share their standard deviations. The log TCHPR453.html.",
          "The compensation table of the machine's builder: Q406 = -1 is an error, a record of "
          "cycle 450 brings the kinematics back.");

}  // namespace fitgauge::probing::cycle_453
