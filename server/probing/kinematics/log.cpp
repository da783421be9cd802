#include "probing/kinematics/log.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "probing/log/html_log.hpp"
#include "probing/log/measuring_log.hpp"
#include "probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using machine::Axis;

std::string mm(double value) { return log_text(to_length(value), false); }
std::string degrees(double value) { return fixed(value, 4); }

std::string row(std::string_view label, std::string_view value) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", label, value);
}

std::string components(const Vec3& v, std::string (*text)(double)) {
  return fmt::format("X {}, Y {}, Z {}", text(v.x), text(v.y), text(v.z));
}

/// Where the measured axes stood: `A -30.0000 C 90.0000`.
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
  std::string html =
      "<table>\n<thead><tr><th scope=\"col\">Position in degrees</th><th scope=\"col\">X</th>"
      "<th scope=\"col\">Y</th><th scope=\"col\">Z</th><th scope=\"col\">Error in space</th>"
      "<th scope=\"col\">After correction</th></tr></thead>\n<tbody>\n";
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vec3& error = before.errors[k];
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td>"
        "</tr>\n",
        position_text(poses[k], axes), mm(error.x), mm(error.y), mm(error.z), mm(norm(error)),
        mm(norm(after.errors[k])));
  }
  return html + "</tbody>\n</table>\n";
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

/// What the positions can and cannot say.
std::string judged(const AxisErrors& errors, bool directions) {
  std::string html;
  if (!errors.location) {
    return "<p class=\"verdict none\">– These positions cannot see the location of the axis: "
           "nothing was determined</p>\n";
  }
  const auto [style, words] = valuation_of(errors.valuation);
  html += fmt::format("<p class=\"verdict {}\">{} (valuation number {:.1f})</p>\n", style, words,
                      errors.valuation);
  if (directions && !errors.tilt_deg) {
    html +=
        "<p class=\"verdict none\">– These positions cannot see the direction of the axis: only "
        "its location was determined</p>\n";
  }
  return html;
}

/// What was found of an error and how sure it is. @param what "the location error".
std::string error_rows(std::string_view label, std::string_view what, const FoundError& found,
                       std::string (*text)(double)) {
  std::string html = row(label, components(found.value, text));
  if (found.uncertainty != Vec3{}) {
    html += row(fmt::format("Uncertainty of {} (95 %)", what), components(found.uncertainty, text));
  }
  if (!found.is_significant) {
    html +=
        row(fmt::format("Significance of {}", what), "▲ less than twice its standard uncertainty");
  }
  return html;
}

std::string error_rows(const AxisErrors& errors) {
  std::string html;
  if (errors.location) {
    html += error_rows("Location error", "the location error", *errors.location, mm);
  }
  if (errors.tilt_deg) {
    html += error_rows("Direction error, turned around the axes, in degrees", "the direction error",
                       *errors.tilt_deg, degrees);
  }
  if (errors.zero_deg) {
    html += error_rows("Error of the zero, turned around the axes, in degrees",
                       "the error of the zero", *errors.zero_deg, degrees);
  }
  return html;
}

std::string deviation_rows(const Spread& before, const Spread& after) {
  const bool one = before.errors.size() < 3;
  return row(one ? "Measured error of the position" : "Measured dispersion (root mean square)",
             mm(before.deviation)) +
         row(one ? "Error after correction" : "Optimised dispersion (root mean square)",
             mm(after.deviation));
}

std::string axis_text(const AxisMeasurement& axis, bool directions) {
  const AxisPlan& plan = axis.plan;
  const std::array only{plan.axis};
  std::string html = fmt::format(
      "<h3>Axis {}</h3>\n<p>{} positions from {} to {} degrees{}; it stands at {} while other "
      "axes are measured</p>\n",
      name(plan.axis), plan.points, degrees(plan.start), degrees(plan.end),
      plan.grid > 0 ? fmt::format(" on a Hirth grid of {}", degrees(plan.grid)) : "",
      degrees(plan.incidence));
  html += judged(axis.errors, directions) + positions(axis.poses, only, axis.before, axis.after) +
          "<table>\n<tbody>\n" + deviation_rows(axis.before, axis.after) + error_rows(axis.errors);
  html += row("Backlash in degrees",
              axis.backlash_deg ? degrees(*axis.backlash_deg) : std::string(axis.no_backlash));
  html += row("Mean positioning error in degrees", degrees(axis.positioning_error_deg));
  html += row("Radius of the measuring circle", mm(axis.radius));
  constexpr double kMicrometre = 0.001;
  html += row("Measuring uncertainty in degrees per µm",
              axis.radius > 0 ? fmt::format("{:.6f}", machine::degrees(kMicrometre / axis.radius))
                              : std::string("none: the sphere lies on the axis"));
  return html + "</tbody>\n</table>\n";
}

/// Writes a section into the log of the cycle.
CycleResult<void> add(const CycleContext& context, std::string_view mode,
                      std::string_view measured) {
  const CycleDescriptor& cycle = context.arguments.descriptor();
  const std::string file = fmt::format("TCHPR{}.html", cycle.number);
  const std::string title = fmt::format("Measuring log of cycle {}", cycle.number);
  const std::string heading =
      fmt::format("Measuring log of touch-probe cycle {} {}", cycle.number, cycle.name);
  const HtmlLog log{file, title, heading, "Errors are real minus modelled.", true};
  return add_section(
      context.host, log,
      fmt::format("<section>\n<h2>Kinematics measured on {}</h2>\n<p>Mode {}; active kinematics 0; "
                  "calibration sphere of radius {}</p>\n{}</section>\n",
                  date_and_time(context.host), mode, mm(context.arguments.number(407)), measured));
}

}  // namespace

CycleResult<void> log_kinematics(const CycleContext& context, const KinematicsReport& report) {
  std::string html;
  if (report.measurement.axes.empty()) html += "<p>No axis was to be measured.</p>\n";
  for (const AxisMeasurement& axis : report.measurement.axes) {
    html += axis_text(axis, report.directions);
  }
  if (report.shift) {
    html += fmt::format("<p>Preset compensation, taken into the kinematics: {}</p>\n",
                        components(*report.shift, mm));
  }
  return add(context, report.mode, html);
}

CycleResult<void> log_grid(const CycleContext& context, std::string_view mode,
                           std::span<const SpherePose> poses, const KinematicsFit& fit) {
  std::vector<Axis> axes;
  std::string html = "<table>\n<tbody>\n" + deviation_rows(fit.before.front(), fit.after.front()) +
                     "</tbody>\n</table>\n";
  for (const AxisErrors& errors : fit.errors) {
    axes.push_back(errors.axis);
    html += fmt::format("<h3>Axis {}</h3>\n{}<table>\n<tbody>\n{}</tbody>\n</table>\n",
                        name(errors.axis), judged(errors, true), error_rows(errors));
  }
  return add(context, mode, html + positions(poses, axes, fit.before.front(), fit.after.front()));
}

}  // namespace fitgauge::probing
