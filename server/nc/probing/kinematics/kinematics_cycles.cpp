#include "log_templates.hpp"
#include "nc/probing/cycles.hpp"
#include "nc/probing/kinematics/measurement.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/parameters.hpp"

namespace fitgauge::probing::kinematics_cycles {

using machine::Axis;
using machine::Kinematics;
using machine::RotaryAxis;
using namespace fmt::literals;
using namespace parameter;
namespace parts = templates::kinematics;

constexpr int kRecordName = 409;
constexpr std::size_t kMostRecords = 16;
constexpr std::size_t kLongestName = 16;

constexpr HtmlLog kLog{"TCHPR450.html", "Log of cycle 450",
                       "Log of touch-probe cycle 450 SAVE KINEMATICS", "", true};

constexpr std::array k450Parameters =
    list(choice(410, "Mode: 0 save, 1 restore, 2 status, 3 delete", 0, 3),
         optional(ranged(kRecordName, "Number or name of the record", Unit::None, {0, 99999}, {},
                         ValueKind::NumberOrText)));

/// @errors 1017 no name, 1011 a name that is empty, too long or not printable, or a broken number.
CycleResult<std::string> record_name(const Arguments& arguments) {
  if (const std::string* text = arguments.text(q(kRecordName))) {
    const std::string_view name = trim(*text);
    const bool printable = std::ranges::none_of(name, [](unsigned char c) { return c < ' '; });
    if (!name.empty() && name.size() <= kLongestName && printable) return std::string(name);
    return nc_error(1011, "QS409 has 1 to {} characters", kLongestName);
  }
  if (!arguments.has_number(q(kRecordName)))
    return nc_error(1017, "Q409 or QS409 names the record");
  const double number = arguments.number(kRecordName);
  if (number != std::nearbyint(number)) return nc_error(1011, "Q409 must be a whole number");
  return fmt::format("{:.0f}", number);
}

std::string mm(double value) { return log_text(to_length(value), false); }

/// Every transformation of a kinematic model as a table.
std::string table_of(const Kinematics& model) {
  std::string axes;
  for (const auto& [axis, mount, centre, direction, zero] : model.axes()) {
    axes += fmt::format(parts::model_axis, "axis"_a = name(axis),
                        "mount"_a = mount == machine::AxisMount::Table ? "table" : "head",
                        "x"_a = mm(centre.x), "y"_a = mm(centre.y), "z"_a = mm(centre.z),
                        "i"_a = fixed(direction.x, 7), "j"_a = fixed(direction.y, 7),
                        "k"_a = fixed(direction.z, 7));
  }
  const Vec3& offset = model.offset();
  return fmt::format(parts::model, "axes"_a = axes, "x"_a = mm(offset.x), "y"_a = mm(offset.y),
                     "z"_a = mm(offset.z));
}

CycleResult<std::string> save(const CycleContext& context, KinematicsRecords& records,
                              const std::string& record) {
  if (!records.contains(record) && records.size() >= kMostRecords)
    return nc_error(1097, "{} records are stored: delete one first", kMostRecords);
  const Kinematics& active = context.state().kinematics;
  records.insert_or_assign(record, active);
  TRY(context.host.keep_kinematics(records));
  return fmt::format("<p>Saved as {}</p>\n{}", escape_html(record), table_of(active));
}

CycleResult<std::string> restore(const CycleContext& context, const KinematicsRecords& records,
                                 const std::string& record) {
  const auto saved = records.find(record);
  if (saved == records.end()) return nc_error(1096, "record not found: {}", record);
  const std::string before = table_of(context.state().kinematics);
  if (const auto set = context.machine.set_kinematics(saved->second); !set) {
    return nc_error(1096, set.error().text);  // of another machine
  }
  return fmt::format("<p>Restored from {}. Before:</p>\n{}<p>Now:</p>\n{}", escape_html(record),
                     before, table_of(saved->second));
}

std::string status(const KinematicsRecords& records) {
  std::string html = fmt::format("<p>{} of {} records:</p>\n", records.size(), kMostRecords);
  for (const auto& [record, model] : records)
    html += fmt::format("<p>{}</p>\n", escape_html(record));
  return html;
}

CycleResult<std::string> remove(const CycleContext& context, KinematicsRecords& records,
                                const std::string& record) {
  if (records.erase(record) == 0) return nc_error(1011, "record not found: {}", record);
  TRY(context.host.keep_kinematics(records));
  return fmt::format("<p>Deleted {}</p>\n", escape_html(record));
}

/// Runs the action of Q410. @return the text of the log.
CycleResult<std::string> handle(const CycleContext& context) {
  constexpr int kSave = 0;
  constexpr int kRestore = 1;
  constexpr int kStatus = 2;
  const int mode = context.whole(410);
  auto records = TRY(context.host.kinematics_records());
  if (mode == kStatus) return status(records);
  const auto record = TRY(record_name(context));
  if (mode == kSave) return save(context, records, record);
  if (mode == kRestore) return restore(context, records, record);
  return remove(context, records, record);
}

CycleResult<void> manage_kinematics(const CycleContext& context) {
  const auto text = TRY(handle(context));
  return add_section(
      context.host, kLog,
      fmt::format(parts::records, "when"_a = date_and_time(context.host), "text"_a = text));
}

// The parameters and results that cycles 451 to 453 share.

constexpr CycleParameter kTouchesOfSphere =
    choice(423, "Number of touches around the sphere", 3, 8, 4);
constexpr CycleParameter kPresetAtSphere = choice(
    431, "Preset at the sphere: 0 no, 1 before, 2 after, 3 before and after measuring", 0, 3, 0);
constexpr CycleParameter kBacklashAngle =
    newer(angle(432, "Angle to measure the backlash with, 0 off", 3, 0));

constexpr std::array kSphereApproach =
    list(standard_radius("Exact radius of the calibration sphere"), kSetUpClearance,
         length(408, "Retraction height before a rotary axis turns, 0 none", 0),
         ranged(253, "Feed for pre-positioning", Unit::Feed, {0.0001, kLongest}, 750,
                ValueKind::NumberOrMax),
         kFirstTouchAngle);

constexpr double kLargestRotaryAngle = 359.9999;

constexpr std::array kRotaryAxes =
    list(angle(411, "Start angle of A", kLargestRotaryAngle, -90),
         angle(412, "End angle of A", kLargestRotaryAngle, 90),
         angle(413, "Angle of A while other axes are measured", kLargestRotaryAngle, 0),
         choice(414, "Number of positions of A, 0: not measured", 0, 12, 0),
         angle(415, "Start angle of B", kLargestRotaryAngle, -90),
         angle(416, "End angle of B", kLargestRotaryAngle, 90),
         angle(417, "Angle of B while other axes are measured", kLargestRotaryAngle, 0),
         choice(418, "Number of positions of B, 0: not measured", 0, 12, 2),
         angle(419, "Start angle of C", kLargestRotaryAngle, -90),
         angle(420, "End angle of C", kLargestRotaryAngle, 90),
         angle(421, "Angle of C while other axes are measured", kLargestRotaryAngle, 0),
         choice(422, "Number of positions of C, 0: not measured", 0, 12, 2));

/// Always in mm, in an INCH program too.
constexpr std::array kKinematicsResults =
    results(141, Unit::None, "Measured standard deviation of A, mm; -1 not measured",
            "Measured standard deviation of B, mm; -1 not measured",
            "Measured standard deviation of C, mm; -1 not measured",
            "Optimised standard deviation of A, mm; -1 not measured",
            "Optimised standard deviation of B, mm; -1 not measured",
            "Optimised standard deviation of C, mm; -1 not measured", "Offset error in X, mm",
            "Offset error in Y, mm", "Offset error in Z, mm");

constexpr std::array k451Parameters = list(
    choice(406,
           "Mode: 0 check, 1 optimise locations, 2 optimise locations and directions, 3 zeros too",
           0, 3, 0),
    kSphereApproach, kRotaryAxes, kTouchesOfSphere, kPresetAtSphere, kBacklashAngle);

constexpr std::array<std::string_view, 4> kModes{"0 = check", "1 = optimise locations",
                                                 "2 = optimise locations and directions",
                                                 "3 = optimise zeros, locations and directions"};

constexpr std::string_view kMeasuresNoAxis =
    "cycle 451 measures no axis: by Q414, Q418 and Q422 each rotary axis of the machine stays at 0";

/// The error of the axis that was measured last.
Vec3 offset_error(const KinematicsMeasurement& measurement) {
  const auto& errors = measurement.fit.errors;
  const bool is_known = !errors.empty() && errors.back().location();
  return is_known ? errors.back().location()->value : Vec3{};
}

CycleResult<void> measure_axes(const CycleContext& context) {
  const int mode = context.whole(406);
  const PresetAtSphere preset(context.whole(431));
  const auto plans = TRY(plan_positions(context, context.state()));
  TRY(preset.check(context));
  if (std::ranges::all_of(plans, [](const AxisPlan& plan) { return plan.positions.empty(); }))
    TRY(context.host.note(kMeasuresNoAxis));
  auto probing = TRY(KinematicsProbing::begin(context));
  TRY(preset.before(context, probing));

  FitOptions options = fit_options(context, mode != 1);
  options.zeros = mode == 3;
  const auto measurement = TRY(measure_kinematics(context, probing, plans, options));
  write_kinematics_results(context.host, measurement, offset_error(measurement));
  TRY(log_kinematics(context, kModes.at(static_cast<std::size_t>(mode)), measurement, mode != 1));
  if (mode != 0) TRY(correct_kinematics(context, measurement.fit));
  return preset.after(context, probing);
}

constexpr std::array k452Parameters =
    list(kSphereApproach, kRotaryAxes, kTouchesOfSphere, kBacklashAngle);

/// Returns the place of the sphere by the corrected model, all axes at zero: the mean of the axes.
Vec3 place_of_sphere(const KinematicsFit& fit) {
  Vec3 sum;
  for (const Spread& of_axis : fit.after) sum = sum + of_axis.centre;
  return sum * (1 / static_cast<double>(fit.after.size()));
}

/// Returns the machine as seen from a tool that is `shift` further; places on the bed stay.
Kinematics compensated(const Kinematics& model, const Vec3& shift) {
  std::vector<RotaryAxis> axes = model.axes();
  for (RotaryAxis& axis : axes) {
    if (axis.mount == machine::AxisMount::Table) axis.centre = axis.centre - shift;
  }
  return Kinematics(std::move(axes), model.offset() - shift);
}

CycleResult<void> check_complete(const KinematicsFit& fit) {
  if (fit.errors.empty()) return nc_error(1102, "no axis is to be measured");
  const auto lost =
      std::ranges::find_if(fit.errors, [](const auto& each) { return !each.location(); });
  if (lost == fit.errors.end()) return {};
  return nc_error(1102, "the positions cannot see the location of axis {}", name(lost->axis));
}

CycleResult<void> compensate(const CycleContext& context) {
  const auto plans = TRY(plan_positions(context, context.state()));
  auto probing = TRY(KinematicsProbing::begin(context));
  const Vec3 preset = probing.sphere();
  const auto measurement = TRY(measure_kinematics(context, probing, plans, {.directions = false}));
  TRY(check_complete(measurement.fit));

  const Vec3 shift = place_of_sphere(measurement.fit) - preset;
  TRY(context.machine.set_kinematics(compensated(measurement.fit.corrected, shift)));
  write_kinematics_results(context.host, measurement, shift);
  TRY(log_kinematics(context, "preset compensation", measurement, false, shift));
  TRY(probing.turn({}));
  return probing.retract();
}

constexpr std::array k453Parameters =
    list(choice(406, "Mode: -1 delete, 0 check, 1 optimise", -1, 1, 0), kSphereApproach,
         kTouchesOfSphere, kPresetAtSphere);
constexpr std::array k453Results =
    results(141, Unit::None, "Measured standard deviation of A, mm; -1 no such axis",
            "Measured standard deviation of B, mm; -1 no such axis",
            "Measured standard deviation of C, mm; -1 no such axis",
            "Optimised standard deviation of A, mm; -1 no such axis",
            "Optimised standard deviation of B, mm; -1 no such axis",
            "Optimised standard deviation of C, mm; -1 no such axis");

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
  const int mode = context.whole(406);
  const PresetAtSphere preset(context.whole(431));
  if (mode == -1)
    return nc_error(1097, "corrections go into the kinematic model: restore a record of cycle 450");
  const auto grid = TRY(grid_of(context.state()));
  TRY(preset.check(context));
  auto probing = TRY(KinematicsProbing::begin(context));
  TRY(preset.before(context, probing));

  PoseGroup poses;
  for (const Vec3& position : grid.positions) {
    const auto pose = TRY(probing.measure(position));
    poses.push_back(pose);
  }
  const KinematicsFit fit = fit_kinematics(std::array{poses}, context.state().kinematics,
                                           probing.tool(), grid.axes, fit_options(context, true));
  write_results(context.host, grid, fit);
  const std::string_view words = mode == 1 ? "1 = optimise" : "0 = check";
  TRY(log_grid(context, words, poses, fit));
  if (mode == 1) TRY(correct_kinematics(context, fit));
  return preset.after(context, probing);
}

constexpr TouchProbeCycle kCycles[] = {
    cycle(450, "SAVE KINEMATICS", CycleKind::Kinematics, k450Parameters, {},
          {1011, 1017, 1096, 1097}, manage_kinematics,
          "All modes, with a number (Q409) or a name of up to 16 characters (QS409). Up to 16 "
          "records in TNC:\\table\\DATA450.KD, which, as all that a run writes, stays in the run "
          "unless it is put on the control's disk. The log TCHPR450.html has every axis, before "
          "and after restoring; the status is its list of records."),

    cycle(451, "MEASURE KINEMATICS", CycleKind::Kinematics, k451Parameters, kKinematicsResults,
          errors::kTouching | errors::kKinematics | ErrorSet{1005, 1085}, measure_axes,
          "All parameters, against the calibration_sphere of the setup. All measured axes are "
          "fitted together, the others standing at their incidence. Q406 = 1 corrects the location "
          "of each measured axis in the kinematic model, 2 its direction too; 0 says what 2 would "
          "correct. 3 corrects the zeros besides: what a measured axis is tilted by around the "
          "measured axis that carries it is that axis' zero (a C that leans around A shows where A "
          "0 really stands), and the preset is to be set anew (Q431). The zero of the axis next to "
          "the sphere or to the tool shows in no position: it belongs to the preset or to the "
          "probe. An error below twice its uncertainty is not corrected: 1102 when nothing is left "
          "to correct, or a note with insignificant_corrections of the setup. Beyond its "
          "max_modification_mm the cycle stops for NC Start before it corrects. Q408 = 0 needs the "
          "option of TCPM (tcpm_option): the probe then circles the sphere. A reference is "
          "measured at 0 degrees of each axis. Q141 to Q146 are the root mean square of the errors "
          "in space, with one position beside the reference its error; Q144 to Q146 are what the "
          "next check finds. Q147 to Q149 are the location error of the axis measured last, real "
          "minus modelled. What the positions cannot see is not corrected, and the log says so; "
          "nor can they tell what another axis has come to rest with from a location error. The "
          "axes end at 0. An axis of strobe_rotary_axes stands at 0 before the start, gets its "
          "targets in Q120 to Q122 for its M function and has no backlash measured. Backlash is "
          "measured, never compensated. The log TCHPR451.html."),
    cycle(452, "PRESET COMPENSATION", CycleKind::Kinematics, k452Parameters, kKinematicsResults,
          errors::kTouching | errors::kKinematics | ErrorSet{1005}, compensate,
          "All parameters. Measures as 451 and corrects the location of each measured axis; then "
          "the kinematic model is shifted so that the active preset, which keeps its values, lies "
          "in the centre of the sphere: for a head that was exchanged, and for drift. Q147 to Q149 "
          "are that shift. The log TCHPR452.html."),
    cycle(453, "KINEMATICS GRID", CycleKind::Kinematics, k453Parameters, k453Results,
          errors::kTouching | errors::kKinematics | ErrorSet{1085, 1097}, measure_grid,
          "Measures the calibration_sphere of the setup at every combination of five positions of "
          "each rotary axis, evenly over its range but at most half a turn to either side, and "
          "finds location and direction of all axes together; Q406 = 1 corrects them in the "
          "kinematic model. All axes share their standard deviations. The log TCHPR453.html.",
          "The compensation table of the machine's builder: Q406 = -1 is an error, a record of "
          "cycle 450 brings the kinematics back.")};

}  // namespace fitgauge::probing::kinematics_cycles

constinit const std::span<const fitgauge::probing::TouchProbeCycle>
    fitgauge::probing::kKinematicsCycles = kinematics_cycles::kCycles;
