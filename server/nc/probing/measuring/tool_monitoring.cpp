#include "nc/probing/measuring/tool_monitoring.hpp"

#include <fmt/format.h>

#include <cmath>

namespace fitgauge::probing {
namespace {

using machine::Tool;

/// The row that Q330 names, null when it is 0.
CycleResult<const Tool*> named_tool(const CycleContext& context) {
  const auto& tools = context.machine.state().tools;
  const Tool* found = nullptr;
  std::string said;
  if (const std::string* name = context.arguments.text(q(330))) {
    found = tools.find(*name);
    said = '"' + *name + '"';
  } else {
    const double number = context.arguments.number(330);
    if (number == 0) return found;
    if (number == std::nearbyint(number)) found = tools.find(static_cast<int>(number));
    said = fmt::format("{}", number);
  }
  if (found == nullptr) return nc_error(1092, fmt::format("Q330 names tool {}", said));
  return found;
}

}  // namespace

ToolCorrection radius_correction(const MeasuredValue& size) {
  const Length half = to_length(size.deviation().to_mm() / 2);
  return {ToolCorrection::Target::Radius, size.role == ValueRole::HoleSize ? half : -half,
          size.deviation()};
}

ToolCorrection face_correction(Length deviation, int direction) {
  return {ToolCorrection::Target::Radius, direction > 0 ? deviation : -deviation, deviation};
}

ToolCorrection length_correction(Length deviation) {
  return {ToolCorrection::Target::Length, -deviation, deviation};
}

CycleResult<void> correct_tool(const CycleContext& context, const ToolCorrection& correction) {
  const auto found = named_tool(context);
  if (!found) return found.error();
  if (*found == nullptr) return {};
  Tool tool = **found;
  const bool radius = correction.target == ToolCorrection::Target::Radius;
  double& oversize = radius ? tool.dr : tool.dl;
  oversize = to_length(oversize + correction.change.to_mm()).to_mm();
  const Length breakage = to_length(radius ? tool.r_breakage : tool.l_breakage);
  const bool broken = breakage > Length{} && magnitude(correction.deviation) > breakage;
  tool.locked = tool.locked || broken;
  if (auto written = context.machine.write_tool(tool); !written) {
    return from_machine(written.error());
  }
  if (!broken) return {};
  return nc_error(1065, fmt::format("deviation {} mm, tool {} is locked",
                                    format_mm(correction.deviation), tool.number));
}

}  // namespace fitgauge::probing
