#include "probing/calibration/calibration_log.hpp"

#include <fmt/format.h>

#include "probing/log/html_log.hpp"
#include "probing/log/measuring_log.hpp"
#include "probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

constexpr HtmlLog kLog{"TCHPRAUTO.html", "Calibration log", "Calibration of the touch probe", ""};

std::string row(std::string_view label, double before, double after, bool inch) {
  const Length old_value = to_length(before);
  const Length new_value = to_length(after);
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", label,
                     log_text(old_value, inch), log_text(new_value, inch),
                     log_text(new_value - old_value, inch));
}

}  // namespace

CycleResult<void> log_calibration(const CycleContext& context, const machine::ProbeSystem& before,
                                  const machine::ProbeSystem& after, Length residual) {
  const CycleDescriptor& cycle = context.arguments.descriptor();
  const bool inch = context.host.is_inch();
  std::string html = fmt::format(
      "<section>\n<h2>Cycle {} {} on {}</h2>\n<p>Tool {}, row {} of tchprobe.tp</p>\n"
      "<table>\n<thead><tr><th scope=\"col\">Value</th><th scope=\"col\">Before</th>"
      "<th scope=\"col\">After</th><th scope=\"col\">Change</th></tr></thead>\n<tbody>\n",
      cycle.number, cycle.name, date_and_time(context.host), context.machine.state().tool.number,
      after.data.number);
  html += row("Effective ball radius", before.radius, after.radius, inch);
  html += row("Centre offset CAL_OF1", before.data.cal_of1, after.data.cal_of1, inch);
  html += row("Centre offset CAL_OF2", before.data.cal_of2, after.data.cal_of2, inch);
  html += row("Effective length", before.length, after.length, inch);
  html += fmt::format(
      "</tbody>\n</table>\n<p>Largest distance from the fitted circle: {}</p>\n"
      "</section>\n",
      log_text(residual, inch));
  return add_section(context.host, kLog, html);
}

}  // namespace fitgauge::probing
