#include "nc/probing/kinematics/measurement.hpp"

#include "log_templates.hpp"
#include "nc/probing/log/measuring_log.hpp"

namespace fitgauge::probing {
namespace {

using namespace fmt::literals;
using machine::Axis;
namespace parts = templates::kinematics;

std::string mm(double value) { return log_text(to_length(value), false); }
std::string degrees(double value) { return fixed(value, 4); }

std::string components(const Vec3& v, std::string (*text)(double)) {
  return fmt::format("X {}, Y {}, Z {}", text(v.x), text(v.y), text(v.z));
}

/// Writes the positions of the measured axes: `A -30.0000 C 90.0000`.
std::string position_text(const SpherePose& pose, std::span<const Axis> axes) {
  std::string text;
  for (const Axis axis : axes) {
    if (!text.empty()) text += ' ';
    text += fmt::format("{} {}", name(axis), degrees(pose.rotary[index(axis) - 3]));
  }
  return text;
}

/// The positions with the sphere's distance from its mean place.
std::string positions(std::span<const SpherePose> poses, std::span<const Axis> axes,
                      const Spread& before, const Spread& after) {
  std::string rows;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vec3& error = before.errors[k];
    rows += fmt::format(parts::position, "position"_a = position_text(poses[k], axes),
                        "x"_a = mm(error.x), "y"_a = mm(error.y), "z"_a = mm(error.z),
                        "error"_a = mm(norm(error)), "after"_a = mm(norm(after.errors[k])));
  }
  return fmt::format(parts::positions, "rows"_a = rows);
}

struct Valuation {
  std::string_view style;
  std::string_view words;
};

Valuation valuation_of(double number) {
  constexpr double kRounding = 1e-6;
  if (number > 4 - kRounding) return {"good", "✓ Good positions"};
  if (number > 2 - kRounding) return {"rework", "▲ Usable positions"};
  return {"scrap", "✗ Poor positions: measure a larger range or more of them"};
}

/// Writes what the positions can determine.
std::string judged(const AxisErrors& errors, bool directions) {
  if (!errors.location()) return parts::no_location;
  const auto [style, words] = valuation_of(errors.valuation);
  std::string html = fmt::format(parts::valuation, "style"_a = style, "words"_a = words,
                                 "number"_a = errors.valuation);
  if (directions && !errors[ErrorKind::Direction]) html += parts::no_direction;
  return html;
}

/// An error and its uncertainty. @param what "the location error".
std::string error_rows(std::string_view label, std::string_view what, const FoundError& found,
                       std::string (*text)(double)) {
  std::string html =
      fmt::format(parts::error, "label"_a = label, "value"_a = components(found.value, text));
  if (found.uncertainty != Vec3{}) {
    html += fmt::format(parts::uncertainty, "what"_a = what,
                        "value"_a = components(found.uncertainty, text));
  }
  if (!found.is_significant) html += fmt::format(parts::insignificant, "what"_a = what);
  return html;
}

std::string error_rows(const AxisErrors& errors) {
  constexpr std::string_view kKinds[][2] = {
      // in the order of ErrorKind
      {"Location error", "the location error"},
      {"Direction error, turned around the axes, in degrees", "the direction error"},
      {"Error of the zero, turned around the axes, in degrees", "the error of the zero"}};
  std::string html;
  for (std::size_t kind = 0; kind < errors.found.size(); ++kind) {
    const auto& [label, what] = kKinds[kind];
    if (const auto& found = errors.found[kind])
      html += error_rows(label, what, *found, kind == 0 ? mm : degrees);
  }
  return html;
}

std::string deviation_rows(const Spread& before, const Spread& after) {
  const std::string old_value = mm(before.deviation);
  const std::string new_value = mm(after.deviation);
  if (before.errors.size() < 3)
    return fmt::format(parts::deviation_of_position, "before"_a = old_value, "after"_a = new_value);
  return fmt::format(parts::dispersion, "before"_a = old_value, "after"_a = new_value);
}

std::string axis_text(const KinematicsMeasurement& measurement, std::size_t k, bool directions) {
  const AxisMeasurement& axis = measurement.axes[k];
  const AxisPlan& plan = axis.plan;
  const KinematicsFit& fit = measurement.fit;
  const std::array only{plan.axis};
  constexpr double kMicrometre = 0.001;
  return fmt::format(
      parts::axis, "axis"_a = name(plan.axis), "points"_a = plan.points,
      "start"_a = degrees(plan.start), "end"_a = degrees(plan.end),
      "grid"_a = plan.grid > 0 ? fmt::format(" on a Hirth grid of {}", degrees(plan.grid)) : "",
      "incidence"_a = degrees(plan.incidence), "judged"_a = judged(fit.errors[k], directions),
      "positions"_a = positions(measurement.poses[k], only, fit.before[k], fit.after[k]),
      "deviations"_a = deviation_rows(fit.before[k], fit.after[k]),
      "errors"_a = error_rows(fit.errors[k]),
      "backlash"_a =
          axis.backlash_deg ? degrees(*axis.backlash_deg) : std::string(axis.no_backlash),
      "positioning_error"_a = degrees(axis.positioning_error_deg), "circle"_a = mm(axis.radius),
      "uncertainty"_a = axis.radius > 0
                            ? fmt::format("{:.6f}", machine::degrees(kMicrometre / axis.radius))
                            : std::string("none: the sphere lies on the axis"));
}

/// Writes a section into the log of the cycle.
CycleResult<void> add(const CycleContext& context, std::string_view mode,
                      std::string_view measured) {
  const CycleDescriptor& cycle = context.descriptor();
  const std::string file = fmt::format("TCHPR{}.html", cycle.number);
  const std::string title = fmt::format("Measuring log of cycle {}", cycle.number);
  const std::string heading =
      fmt::format("Measuring log of touch-probe cycle {} {}", cycle.number, cycle.name);
  const HtmlLog log{file, title, heading, "Errors are real minus modelled.", true};
  return add_section(
      context.host, log,
      fmt::format(parts::section, "when"_a = date_and_time(context.host), "mode"_a = mode,
                  "radius"_a = mm(context.number(407)), "measured"_a = measured));
}

}  // namespace

CycleResult<void> log_kinematics(const CycleContext& context, std::string_view mode,
                                 const KinematicsMeasurement& measurement, bool directions,
                                 const std::optional<Vec3>& shift) {
  std::string html;
  if (measurement.axes.empty()) html += parts::no_axis;
  for (std::size_t k = 0; k < measurement.axes.size(); ++k)
    html += axis_text(measurement, k, directions);
  if (shift) html += fmt::format(parts::shift, "shift"_a = components(*shift, mm));
  return add(context, mode, html);
}

CycleResult<void> log_grid(const CycleContext& context, std::string_view mode,
                           std::span<const SpherePose> poses, const KinematicsFit& fit) {
  std::vector<Axis> axes;
  std::string html;
  for (const AxisErrors& errors : fit.errors) {
    axes.push_back(errors.axis);
    html += fmt::format(parts::axis_of_grid, "axis"_a = name(errors.axis),
                        "judged"_a = judged(errors, true), "errors"_a = error_rows(errors));
  }
  const Spread& before = fit.before.front();
  const Spread& after = fit.after.front();
  return add(context, mode,
             fmt::format(parts::grid, "deviations"_a = deviation_rows(before, after),
                         "axes"_a = html, "positions"_a = positions(poses, axes, before, after)));
}

}  // namespace fitgauge::probing
