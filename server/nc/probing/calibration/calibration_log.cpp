#include "nc/probing/calibration/calibration_log.hpp"

#include <fmt/format.h>

#include "log_templates.hpp"
#include "nc/probing/log/html_log.hpp"
#include "nc/probing/log/measuring_log.hpp"
#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {
namespace {

using namespace fmt::literals;

constexpr HtmlLog kCalibrationLog{"TCHPRAUTO.html", "Calibration log",
                                  "Calibration of the touch probe", ""};

std::string row(std::string_view label, double before, double after, bool inch) {
  const Length old_value = to_length(before);
  const Length new_value = to_length(after);
  return fmt::format(templates::calibration::row, "label"_a = label,
                     "before"_a = log_text(old_value, inch), "after"_a = log_text(new_value, inch),
                     "change"_a = log_text(new_value - old_value, inch));
}

}  // namespace

CycleResult<void> log_calibration(const CycleContext& context, const machine::ProbeSystem& before,
                                  const machine::ProbeSystem& after, Length residual) {
  const CycleDescriptor& cycle = context.arguments.descriptor();
  const bool inch = context.host.is_inch();
  const std::string section = fmt::format(
      templates::calibration::section, "cycle"_a = cycle.number, "name"_a = cycle.name,
      "when"_a = date_and_time(context.host), "tool"_a = context.machine.state().tool.number,
      "row"_a = after.data.number,
      "radius"_a = row("Effective ball radius", before.radius, after.radius, inch),
      "main"_a = row("Centre offset CAL_OF1", before.data.cal_of1, after.data.cal_of1, inch),
      "secondary"_a = row("Centre offset CAL_OF2", before.data.cal_of2, after.data.cal_of2, inch),
      "length"_a = row("Effective length", before.length, after.length, inch),
      "residual"_a = log_text(residual, inch));
  return add_section(context.host, kCalibrationLog, section);
}

}  // namespace fitgauge::probing
