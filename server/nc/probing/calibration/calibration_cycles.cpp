#include "log_templates.hpp"
#include "nc/machine/tolerance.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/parameters.hpp"
#include "nc/probing/touch/probing_motion.hpp"

namespace fitgauge::probing::calibration_cycles {

using machine::MachineState;
using namespace fmt::literals;
using namespace parameter;

/// Parameters of 460, 462 and 463 for touching a standard.
constexpr CycleParameter kStandardRadius = standard_radius("Exact radius of the standard");
constexpr CycleParameter kStandardTouches = choice(423, "Number of touches", 3, 8, 4);

/// The circle, or sphere, of the ball centres around a standard as the control computes them with
/// the probe data it has; in plane coordinates.
struct RoundStandard {
  machine::Vec3 centre;
  double radius = 0;    ///< of the ball centres, not of the surface
  double residual = 0;  ///< largest distance of a touch from the circle
};

/// A standard measured with the spindle at 0 and at 180 degrees.
struct ReversalResult {
  RoundStandard mean;
  machine::Vec3 error;  ///< of CAL_OF1 and CAL_OF2: to be added, in machine coordinates
};

/// The result of a calibration; values it does not determine stay as they are in the tables.
struct ProbeCalibration {
  std::optional<double> radius{};                        ///< effective ball radius, in mm
  std::optional<std::array<double, 2>> centre_offset{};  ///< CAL_OF1, CAL_OF2, with CAL_ANG 0
  std::optional<double> length{};                        ///< effective length, in mm
  double residual = 0;
};

constexpr HtmlLog kCalibrationLog{"TCHPRAUTO.html", "Calibration log",
                                  "Calibration of the touch probe", ""};

std::string row(std::string_view label, double before, double after, bool inch) {
  const Length old_value = to_length(before);
  const Length new_value = to_length(after);
  return fmt::format(templates::calibration::row, "label"_a = label,
                     "before"_a = log_text(old_value, inch), "after"_a = log_text(new_value, inch),
                     "change"_a = log_text(new_value - old_value, inch));
}

/// Adds a calibration of the touch probe to TCHPRAUTO.html beside the program.
/// @param residual the largest distance of a touch from the fitted circle.
/// @errors when the run's output budget is used up.
CycleResult<void> log_calibration(const CycleContext& context, const machine::ProbeSystem& before,
                                  const machine::ProbeSystem& after, Length residual) {
  const CycleDescriptor& cycle = context.descriptor();
  const bool inch = context.host.log_is_inch();
  const std::string section = fmt::format(
      templates::calibration::section, "cycle"_a = cycle.number, "name"_a = cycle.name,
      "when"_a = date_and_time(context.host), "tool"_a = context.state().tool.number,
      "row"_a = after.data.number,
      "radius"_a = row("Effective ball radius", before.radius, after.radius, inch),
      "main"_a = row("Centre offset CAL_OF1", before.data.cal_of1, after.data.cal_of1, inch),
      "secondary"_a = row("Centre offset CAL_OF2", before.data.cal_of2, after.data.cal_of2, inch),
      "length"_a = row("Effective length", before.length, after.length, inch),
      "residual"_a = log_text(residual, inch));
  return add_section(context.host, kCalibrationLog, section);
}

CycleResult<void> check_straight(const MachineState& state, machine::Axis probe) {
  if (norm(state.tool_direction() - unit_vector(probe)) <= tolerance::kSameDirection) return {};
  return nc_error(1075, "the probe stands along the probe axis while it is calibrated");
}

CycleResult<double> positive(double value, std::string_view what) {
  if (value > 0) return to_length(value).to_mm();
  return nc_error(1080, "{} of {:.4f} mm", what, value);
}

/// The calibration of the touch probe in the spindle, which is above or in the standard. The
/// computed ball centre is off by the error of CAL_OF1 and CAL_OF2, and to the other side after the
/// spindle turns by 180 degrees: the middle of both is right. Not thread-safe; lives within one
/// execution. After an error no table has changed.
class ProbeCalibrator {
 public:
  using Pass = std::function<CycleResult<RoundStandard>(const Vec3& near)>;

  /// @errors 1007 and 1008 with scaling or mirror active, 1075 in a tilted plane, and those of
  ///   ProbingMotion::begin.
  static CycleResult<ProbeCalibrator> begin(const CycleContext& context) {
    const MachineState& state = context.state();
    TRY(refuse_mirror_and_scaling(state.frames));
    const auto motion = TRY(ProbingMotion::begin(context));
    TRY(check_straight(state, motion.plane().probe));
    return ProbeCalibrator(context, motion);
  }

  ProbingMotion& motion() { return motion_; }
  /// Position of the ball's south pole at the beginning, in plane coordinates: its height is the
  /// clearance height.
  const Vec3& start() const { return start_; }

  /// Touches Q423 times around a point from the angle Q380 on, the ball centre at its height.
  CycleResult<RoundStandard> touch_around(Side side, const Vec3& centre) {
    const int points = context_.whole(423);
    constexpr double kTurn = 360;
    const auto touches = circle_touches({.side = side,
                                         .centre = centre,
                                         .diameter = 2 * context_.number(407),
                                         .start_angle = context_.number(380),
                                         .step = kTurn / points,
                                         .points = points,
                                         .start_distance = motion_.start_distance(),
                                         .via_clearance = context_.number_or(301, 0) == 1});
    const auto contacts = TRY(motion_.touch_all(touches, start_.z));
    const auto circle = TRY(circle_through(contacts, side, 0));
    return RoundStandard{
        {circle.centre.x, circle.centre.y, centre.z}, circle.radius, circle.residual};
  }

  /// Probes once from the current position to find the standard, then once at its centre for each
  /// position of the spindle. Ends at the clearance height over the centre.
  CycleResult<ReversalResult> measure(const Pass& pass) {
    const auto near = TRY(turned(0, pass, start_));
    const auto first = TRY(turned(0, pass, near.centre));
    const auto second = TRY(turned(180, pass, near.centre));
    const RoundStandard mean{(first.centre + second.centre) * 0.5,
                             (first.radius + second.radius) / 2,
                             std::max(first.residual, second.residual)};
    TRY(motion_.move_tip(machine::AxisWords::linear(
        motion_.plane().to_input({mean.centre.x, mean.centre.y, start_.z}))));
    Vec3 error = (second.centre - first.centre) * 0.5;
    error.z = 0;
    return ReversalResult{
        mean, context_.state().frames.direction_to_machine(motion_.plane().to_input(error))};
  }

  /// Writes tool.t and tchprobe.tp, then the log TCHPRAUTO.html.
  /// @errors 1080 a radius or length that is not positive.
  CycleResult<void> finish(const ProbeCalibration& found) {
    machine::Machine& machine = context_.machine;
    const MachineState& state = machine.state();
    const machine::ProbeSystem before = *state.probe_system();
    machine::ProbeRow row = before.data;
    if (found.centre_offset) {
      row.cal_of1 = found.centre_offset->front();
      row.cal_of2 = found.centre_offset->back();
      row.cal_ang = 0;
    }
    // The effective values include DL and DR of the tool call; DL and DR of the table become zero.
    machine::Tool tool = *state.active_tool();
    if (found.radius) {
      const auto radius = TRY(positive(*found.radius, "effective ball radius"));
      tool.r = radius - state.tool.dr;
      tool.dr = 0;
    }
    if (found.length) {
      const auto length = TRY(positive(*found.length, "effective length"));
      tool.l = length - state.tool.dl;
      tool.dl = 0;
    }
    TRY(machine.write_probe(row));
    TRY(machine.write_tool(tool));
    return log_calibration(context_, before, *state.probe_system(), to_length(found.residual));
  }

  /// CAL_OF1 and CAL_OF2 for spindle angle 0, with their error corrected.
  std::array<double, 2> corrected_offset(const Vec3& error) const {
    const MachineState& state = context_.state();
    const Vec3 offset = state.probe_system()->centre_offset(state.tool_axis(), 0) + error;
    const std::size_t up = index(state.tool_axis());
    return {to_length(offset[(up + 1) % 3]).to_mm(), to_length(offset[(up + 2) % 3]).to_mm()};
  }

 private:
  ProbeCalibrator(const CycleContext& context, const ProbingMotion& motion)
      : context_(context),
        motion_(motion),
        start_(motion.plane().from_input(context.machine.position().linear)) {}

  CycleResult<RoundStandard> turned(double spindle_deg, const Pass& pass, const Vec3& near) {
    const auto orient = [this](double degrees) {
      machine::Modes modes = context_.state().modes;
      modes.spindle_deg = degrees;
      return context_.machine.set_modes(modes);
    };
    const double before = context_.state().modes.spindle_deg;
    TRY(orient(spindle_deg));
    auto found = pass(near);
    TRY(orient(before));
    return found;
  }

  const CycleContext& context_;
  ProbingMotion motion_;
  Vec3 start_;
};

constexpr std::array k460Parameters =
    list(kStandardRadius, kSetUpClearance, kMoveToClearance, kStandardTouches, kFirstTouchAngle,
         choice(433, "Calibrate the length: 0 no, 1 yes", 0, 1, 0),
         coordinate(434, "Coordinate of the sphere's centre in the probe axis", 0),
         newer(choice(455, "Number of points of the 3-D calibration", 0, 30, 0)));

/// The sphere through a horizontal circle and a point near its pole.
RoundStandard sphere_through(const RoundStandard& circle, const Vec3& pole) {
  const double beside = std::hypot(pole.x - circle.centre.x, pole.y - circle.centre.y);
  const double above = pole.z - circle.centre.z;
  const double rise =
      (above * above + beside * beside - circle.radius * circle.radius) / (2 * above);
  return {circle.centre + Vec3{0, 0, rise}, std::hypot(circle.radius, rise), circle.residual};
}

/// Touches the sphere from above and around its equator.
CycleResult<RoundStandard> touch_sphere(ProbeCalibrator& calibrator, double radius,
                                        const Vec3& near) {
  ProbingMotion& motion = calibrator.motion();
  const double start_height = calibrator.start().z;
  const std::array down{Touch{.start = {near.x, near.y, start_height + motion.ball_radius()},
                              .direction = {0, 0, -1}}};
  const auto contacts = TRY(motion.touch_all(down, start_height));
  const Vec3 pole = contacts.front().ball_centre;
  const double equator = pole.z - (radius + motion.ball_radius());
  const auto circle = TRY(calibrator.touch_around(Side::Outside, {near.x, near.y, equator}));
  return sphere_through(circle, pole);
}

CycleResult<void> calibrate_on_sphere(const CycleContext& context) {
  const double radius = context.number(407);
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const auto measured =
      TRY(calibrator.measure(std::bind_front(touch_sphere, std::ref(calibrator), radius)));

  const machine::ProbeSystem probe = *context.state().probe_system();
  ProbeCalibration found{.radius = measured.mean.radius - radius,
                         .centre_offset = calibrator.corrected_offset(measured.error),
                         .residual = measured.mean.residual};
  if (context.whole(433) == 1) {
    // The ball centre is one radius above the south pole, where the length ends.
    const double too_high = measured.mean.centre.z - context.number(434);
    found.length = probe.length + too_high + *found.radius - probe.radius;
  }
  return calibrator.finish(found);
}

constexpr std::array k461Parameters{
    coordinate(434, "Coordinate of the touched surface in the probe axis")};

CycleResult<void> calibrate_length(const CycleContext& context) {
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const auto contact = TRY(calibrator.motion().probe({0, 0, -1}));
  const double too_high = contact.surface.z - context.number(434);
  return calibrator.finish({.length = context.state().probe_system()->length + too_high});
}

constexpr std::array k462Parameters{kStandardRadius, kSetUpClearance, kStandardTouches,
                                    kFirstTouchAngle};
constexpr std::array k463Parameters{kStandardRadius, kSetUpClearance, kMoveToClearance,
                                    kStandardTouches, kFirstTouchAngle};

/// Returns the height of the ball centre. In a ring it is the present height. The upper edge of a
/// stud is assumed at the clearance below the probe, and is touched one ball diameter lower.
double measuring_height(ProbeCalibrator& calibrator, Side side) {
  const ProbingMotion& motion = calibrator.motion();
  const double height = calibrator.start().z;
  if (side == Side::Inside) return height + motion.ball_radius();
  return height - motion.start_distance() - motion.ball_radius();
}

CycleResult<void> calibrate_radius(const CycleContext& context, Side side) {
  auto calibrator = TRY(ProbeCalibrator::begin(context));
  const double height = measuring_height(calibrator, side);
  const auto measured = TRY(calibrator.measure([&](const Vec3& near) {
    return calibrator.touch_around(side, {near.x, near.y, height});
  }));
  const double radius = measured.mean.radius - context.number(407);
  return calibrator.finish({.radius = side == Side::Inside ? -radius : radius,
                            .centre_offset = calibrator.corrected_offset(measured.error),
                            .residual = measured.mean.residual});
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(460, "CALIBRATION OF TS ON A SPHERE", CycleKind::Calibration, k460Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, calibrate_on_sphere,
          "From a position above the sphere: its top and equator, twice with the spindle turned by "
          "180 degrees; effective radius, CAL_OF1, CAL_OF2 and, with Q433, the effective length. "
          "The log TCHPRAUTO.html.",
          "Q455: the model of the probe triggers alike in all directions."),
    cycle(461, "TS CALIBRATION OF TOOL LENGTH", CycleKind::Calibration, k461Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, calibrate_length,
          "One touch against the probe axis from where the probe stands, such as on the "
          "calibration ring; the effective length. The log TCHPRAUTO.html."),
    cycle(462, "CALIBRATION OF TS IN RING", CycleKind::Calibration, k462Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, with<calibrate_radius, Side::Inside>,
          "From a position in the ring at measuring height, twice with the spindle turned by 180 "
          "degrees; effective radius, CAL_OF1, CAL_OF2. The log TCHPRAUTO.html."),
    cycle(463, "TS CALIBRATION ON STUD", CycleKind::Calibration, k463Parameters, {},
          errors::kUnscaled | ErrorSet{1075, 1080}, with<calibrate_radius, Side::Outside>,
          "From a position SET_UP + Q320 above the stud, which is touched one ball diameter below "
          "its edge, twice with the spindle turned by 180 degrees; effective radius, CAL_OF1, "
          "CAL_OF2. The log TCHPRAUTO.html.")};

}  // namespace fitgauge::probing::calibration_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kCalibrationCycles = calibration_cycles::kCycles;
