#include "nc/probing/kinematics/measurement.hpp"

#include "nc/machine/tolerance.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;

/// Angles of a block and of a grid in whole billionths of a degree, so steps and ties are exact.
std::int64_t whole(double degrees) { return std::llround(degrees / tolerance::kSameAngle); }

/// Returns the multiple of the grid that is nearest to numerator / denominator; of two equally near
/// ones, the one farther from zero (decision 5).
double nearest_tooth(std::int64_t numerator, std::int64_t denominator, double grid) {
  const std::int64_t tooth = whole(grid) * denominator;
  const std::int64_t count = (2 * std::abs(numerator) + tooth) / (2 * tooth);
  return static_cast<double>(numerator < 0 ? -count : count) * grid;
}

double on_grid(double position, double grid) {
  return grid > 0 ? nearest_tooth(whole(position), 1, grid) : position;
}

CycleResult<void> check_range(Axis axis, double position, const machine::AxisRange& range) {
  if (position >= range.min && position <= range.max) return {};
  return nc_error(1101, "{}{:+.4f} is outside {} to {}", name(axis), position, range.min,
                  range.max);
}

/// Checks the places where the axis will be: its positions, 0, its incidence.
CycleResult<void> check_reach(const AxisPlan& plan, double backlash,
                              const machine::AxisRange& range) {
  std::vector<double> reached{plan.incidence};
  const double beside =
      plan.grid > 0 || plan.strobed || !plan.is_measured() ? 0 : std::abs(backlash);
  const auto reach = [&](double position) {
    reached.push_back(position - beside);
    reached.push_back(position + beside);
  };
  reach(0);
  for (const double position : plan.positions) reach(position);
  for (const double position : reached) TRY(check_range(plan.axis, position, range));
  return {};
}

using machine::Kinematics;

/// Measurement of one axis.
struct Approaches {
  PoseGroup first;
  PoseGroup second;  ///< from the other side; empty without backlash
};

/// Measures at `rotary`, coming from `by` beyond it.
CycleResult<void> approach(KinematicsProbing& probing, const Vec3& rotary, Axis axis, double by,
                           PoseGroup& poses) {
  Vec3 beyond = rotary;
  beyond[index(axis) - 3] += by;
  TRY(probing.turn(beyond));
  const auto pose = TRY(probing.measure(rotary));
  poses.push_back(pose);
  return {};
}

CycleResult<Approaches> measure_axis(KinematicsProbing& probing, const AxisPlan& plan, Vec3 rotary,
                                     double backlash) {
  Approaches found;
  std::vector<double> positions{0};  // the reference
  positions.insert(positions.end(), plan.positions.begin(), plan.positions.end());
  for (const double position : positions) {
    rotary[index(plan.axis) - 3] = position;
    TRY(approach(probing, rotary, plan.axis, -backlash, found.first));
    if (backlash == 0) continue;
    TRY(approach(probing, rotary, plan.axis, backlash, found.second));
  }
  return found;
}

/// Returns the reason why the backlash of an axis is not measured; empty: it is.
std::string_view no_backlash(const AxisPlan& plan, double radius, double backlash_angle) {
  constexpr double kSmallestCircle = 1;  // mm
  if (backlash_angle == 0) return "not asked for (Q432)";
  if (plan.strobed) return "not possible with an axis that an M function positions";
  if (plan.grid > 0) return "not possible on a Hirth axis";
  if (radius < kSmallestCircle) return "the measuring circle is smaller than 1 mm";
  return {};
}

/// Returns `location of axis C (0.0012 mm, twice its uncertainty 0.0300 mm)` for the first
/// insignificant value; of an axis, its location is sufficient.
std::string insignificant(const AxisErrors& errors) {
  // In the order of ErrorKind.
  constexpr std::array<std::string_view, 3> kNames{"location", "direction", "zero"};
  for (std::size_t kind = 0; kind < kNames.size(); ++kind) {
    const auto& found = errors.found[kind];
    if (!found || found->is_significant) continue;
    return fmt::format("{} of axis {} ({:.4f} mm{}, twice its uncertainty {:.4f} mm)", kNames[kind],
                       name(errors.axis), found->size, kind == 0 ? "" : " at 100 mm",
                       2 * found->standard_uncertainty);
  }
  return {};
}

std::string insignificant(std::span<const AxisErrors> errors) {
  std::string all;
  for (const AxisErrors& axis : errors) {
    if (axis.is_significant()) continue;
    all += (all.empty() ? "" : ", ") + insignificant(axis);
  }
  return all;
}

double largest_location(std::span<const AxisErrors> errors) {
  double largest = 0;
  for (const AxisErrors& axis : errors) {
    if (axis.location()) largest = std::max(largest, axis.location()->size);
  }
  return largest;
}

using machine::MachineState;
using machine::Preset;

CycleResult<void> set_preset(const CycleContext& context, KinematicsProbing& probing) {
  const auto reference = TRY(probing.measure({}));
  const MachineState& state = context.state();
  const Vec3 centre = on_table(reference, state.kinematics, probing.tool());
  Preset row = state.preset_row(state.active_preset);
  row.frame.origin = {to_length(centre.x).to_mm(), to_length(centre.y).to_mm(),
                      to_length(centre.z).to_mm()};
  TRY(context.machine.write_preset(row));
  return context.machine.activate_preset(row.number);
}

}  // namespace

std::vector<double> measuring_positions(double start, double end, int points, double grid) {
  std::vector<double> positions;
  const int steps = std::max(points - 1, 1);
  for (int k = 0; k < points; ++k) {
    positions.push_back(
        grid > 0 ? nearest_tooth(whole(start) * (steps - k) + whole(end) * k, steps, grid)
                 : start + k * ((end - start) / steps));
  }
  return positions;
}

CycleResult<std::vector<AxisPlan>> plan_positions(const Arguments& arguments,
                                                  const machine::MachineState& state) {
  std::vector<AxisPlan> plans;
  int first = 411;  // start, end, incidence and points of A; four further of B, then of C
  for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
    const int start = first;
    first += 4;
    const auto& range = state.ranges[index(axis)];
    if (!range) continue;
    AxisPlan plan{.axis = axis,
                  .start = arguments.number(start),
                  .end = arguments.number(start + 1),
                  .incidence = on_grid(arguments.number(start + 2), range->hirth_grid_deg),
                  .points = arguments.whole(start + 3),
                  .grid = range->hirth_grid_deg};
    plan.positions = measuring_positions(plan.start, plan.end, plan.points, plan.grid);
    std::erase_if(plan.positions, [](double p) { return std::abs(p) < tolerance::kSameAngle; });
    plan.strobed = state.kinematics_options.strobed[index(axis) - 3];
    if (plan.strobed && state.nose[axis] != 0) {
      return nc_error(1005,
                      "{} is positioned by an M function and stands at {:+.4f}: "
                      "turn it to 0 before the cycle",
                      name(axis), state.nose[axis]);
    }
    TRY(check_reach(plan, arguments.number_or(432, 0), *range));
    plans.push_back(std::move(plan));
  }
  if (plans.empty()) return nc_error(1100, "the machine has no rotary axis");
  return plans;
}

CycleResult<KinematicsMeasurement> measure_kinematics(const CycleContext& context,
                                                      KinematicsProbing& probing,
                                                      std::span<const AxisPlan> plans,
                                                      const FitOptions& options) {
  const Kinematics active = context.state().kinematics;
  const double angle = context.number_or(432, 0);
  const MeasuringTool tool = probing.tool();
  Vec3 incidence;
  for (const AxisPlan& plan : plans) incidence[index(plan.axis) - 3] = plan.incidence;

  KinematicsMeasurement measurement;
  std::vector<Axis> axes;
  for (const AxisPlan& plan : plans) {
    if (!plan.is_measured()) continue;
    AxisMeasurement measured{.plan = plan};
    measured.radius = measuring_radius(probing.sphere(), *active.find(plan.axis), tool);
    measured.no_backlash = no_backlash(plan, measured.radius, angle);
    const bool both_sides = measured.no_backlash.empty();
    auto found = TRY(measure_axis(probing, plan, incidence, both_sides ? angle : 0));
    if (both_sides) {
      const bool up = angle > 0;
      measured.backlash_deg =
          fit_backlash(up ? found.first : found.second, up ? found.second : found.first, active,
                       tool, plan.axis);
    }
    axes.push_back(plan.axis);
    measurement.poses.push_back(std::move(found.first));
    measurement.axes.push_back(std::move(measured));
  }
  measurement.fit = fit_kinematics(measurement.poses, active, tool, axes, options);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    measurement.axes[k].positioning_error_deg =
        mean_positioning_error(measurement.poses[k], measurement.fit.corrected, tool, axes[k]);
  }
  return measurement;
}

void write_kinematics_results(CycleHost& host, const KinematicsMeasurement& measurement,
                              const Vec3& offset) {
  std::array<double, 3> before{-1, -1, -1};
  std::array<double, 3> after{-1, -1, -1};
  for (std::size_t k = 0; k < measurement.axes.size(); ++k) {
    const AxisPlan& plan = measurement.axes[k].plan;
    if (plan.positions.empty()) continue;  // the reference alone
    before[index(plan.axis) - 3] = to_length(measurement.fit.before[k].deviation).to_mm();
    after[index(plan.axis) - 3] = to_length(measurement.fit.after[k].deviation).to_mm();
  }
  const std::array errors{offset.x, offset.y, offset.z};
  for (std::uint16_t k = 0; k < 3; ++k) {
    const auto number = [k](int first) { return static_cast<std::uint16_t>(first + k); };
    host.set_q(number(141), before[k], Unit::None);
    host.set_q(number(144), after[k], Unit::None);
    host.set_q(number(147), to_length(errors[k]).to_mm(), Unit::None);
  }
}

FitOptions fit_options(const CycleContext& context, bool directions) {
  return {.directions = directions,
          .only_significant = !context.state().kinematics_options.notes_insignificant};
}

CycleResult<void> correct_kinematics(const CycleContext& context, const KinematicsFit& fit) {
  const machine::KinematicsOptions& options = context.state().kinematics_options;
  if (const std::string small = insignificant(fit.errors); !small.empty()) {
    if (!fit.is_corrected)
      return nc_error(1102, small + ": measure a larger range or more positions");
    const std::string_view taken = options.notes_insignificant ? "corrected" : "not corrected";
    TRY(context.host.note(
        fmt::format("cycle {}: {}: {}", context.descriptor().number, taken, small)));
  }
  if (!fit.is_corrected) return {};
  const double largest = largest_location(fit.errors);
  if (options.max_modification && largest > *options.max_modification) {
    const auto confirmed = TRY(context.host.confirm(
        fmt::format("the kinematics change by {:.4f} mm, more than max_modification_mm ({} mm)",
                    largest, *options.max_modification)));
    if (!confirmed) return {};
  }
  return context.machine.set_kinematics(fit.corrected);
}

CycleResult<void> PresetAtSphere::check(const CycleContext& context) const {
  const MachineState& state = context.state();
  const Preset* row = state.presets.find(state.active_preset);
  if ((!sets_before_ && !sets_after_) || row == nullptr || !row->locked) return {};
  return make_fault(machine::FaultKind::PresetLocked,
                    fmt::format("the active preset {}", row->number));
}

CycleResult<void> PresetAtSphere::before(const CycleContext& context,
                                         KinematicsProbing& probing) const {
  if (!sets_before_) return {};
  TRY(probing.find());
  return set_preset(context, probing);
}

CycleResult<void> PresetAtSphere::after(const CycleContext& context,
                                        KinematicsProbing& probing) const {
  auto done = sets_after_ ? set_preset(context, probing) : probing.turn({});
  return done ? probing.retract() : done;
}

}  // namespace fitgauge::probing
