#include "nc/probing/measuring/measurement.hpp"

#include "nc/probing/alignment/rotation.hpp"
#include "nc/probing/log/measuring_log.hpp"

namespace fitgauge::probing {
namespace {

using machine::Tool;

/// The row that Q330 names, null when it is 0.
CycleResult<const Tool*> named_tool(const CycleContext& context) {
  const auto& tools = context.state().tools;
  const Tool* found = nullptr;
  std::string said;
  if (const std::string* name = context.text(q(330))) {
    found = tools.find(*name);
    said = '"' + *name + '"';
  } else {
    const double number = context.number(330);
    if (number == 0) return found;
    if (number == std::nearbyint(number)) found = tools.find(static_cast<int>(number));
    said = fmt::format("{}", number);
  }
  if (found == nullptr) return nc_error(1092, "Q330 names tool {}", said);
  return found;
}

/// What one millimetre of the measured deviation is on the tool, which has no scale (cycle 11,
/// equal in all axes) and no mirror. A size has no sign, and a face turns round with Q267.
double machine_factor(const machine::MachineState& state, ToolCorrection::Target target) {
  const double factor = state.frames.scaling().factor.x;
  const bool turned =
      target == ToolCorrection::Target::Length && state.frames.mirror()[index(state.tool_axis())];
  return turned ? -factor : factor;
}

using gauging::Verdict;

constexpr std::uint16_t kStatusGood = 180;
constexpr std::uint16_t kStatusRework = 181;
constexpr std::uint16_t kStatusReject = 182;

bool has_status(const CycleDescriptor& cycle) {
  return std::ranges::find(cycle.results, kStatusGood, &CycleOutput::q) != cycle.results.end();
}

void set_status(CycleHost& host, std::optional<Verdict> verdict) {
  host.set_q(kStatusGood, verdict == Verdict::Good ? 1 : 0, Unit::None);
  host.set_q(kStatusRework, verdict == Verdict::Rework ? 1 : 0, Unit::None);
  host.set_q(kStatusReject, verdict == Verdict::Reject ? 1 : 0, Unit::None);
}

/// Returns the first value with the worst verdict: reject before rework before good (decision 1),
/// and before a value without limits.
const MeasuredValue& worst(const std::vector<MeasuredValue>& values) {
  return *std::ranges::max_element(
      values, {}, [](const auto& value) { return gauging::severity(value.verdict()); });
}

/// A short arc magnifies the scatter of the touches in the diameter.
void add_short_arc(MeasuringLog& log, const std::optional<Form>& form) {
  constexpr double kShort = 2;  // four touches at right angles: 1, three: 1.15
  if (!form || form->diameter_factor <= kShort) return;
  log.number("Scatter of the diameter per scatter of touch", form->diameter_factor);
}

}  // namespace

void publish(CycleHost& host, std::span<const MeasuredValue> values) {
  for (const MeasuredValue& value : values) {
    if (value.result_q != 0) host.set_q(value.result_q, value.measured.to_mm(), Unit::Length);
    if (value.deviation_q != 0)
      host.set_q(value.deviation_q, value.deviation().to_mm(), Unit::Length);
  }
}

MeasuringRecord record_of(const CycleContext& context, const Measurement& measurement) {
  MeasuringRecord record{.cycle = context.descriptor().number,
                         .sizes = measurement.values,
                         .has_status = true,
                         .verdict = worst(measurement.values).verdict(),
                         .form = measurement.form};
  std::ranges::stable_partition(record.sizes, std::not_fn(&MeasuredValue::is_position));
  return record;
}

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
  const auto found = TRY(named_tool(context));
  if (found == nullptr) return {};
  Tool tool = *found;
  const bool radius = correction.target == ToolCorrection::Target::Radius;
  const double factor = machine_factor(context.state(), correction.target);
  double& oversize = radius ? tool.dr : tool.dl;
  oversize = to_length(oversize + correction.change.to_mm() * factor).to_mm();
  const Length breakage = to_length(radius ? tool.r_breakage : tool.l_breakage);
  const Length deviation = to_length(correction.deviation.to_mm() * factor);
  const bool broken = breakage > Length{} && magnitude(deviation) > breakage;
  tool.locked = tool.locked || broken;
  TRY(context.machine.write_tool(tool));
  if (!broken) return {};
  return nc_error(1065, "deviation {} mm, tool {} is locked", format_mm(deviation), tool.number);
}

CycleResult<ProbingMotion> begin_measurement(const CycleContext& context) {
  const Vec3& factor = context.state().frames.scaling().factor;
  if (factor.x != factor.y || factor.y != factor.z)
    return nc_error(1108, "reset cycle 26 before measuring");
  if (has_status(context.descriptor())) set_status(context.host, std::nullopt);
  TRY(begin_without_rotation(context));
  return ProbingMotion::begin(context);
}

CycleResult<void> finish_measurement(const CycleContext& context, const Measurement& measurement) {
  CycleHost& host = context.host;
  const MeasuredValue& decisive = worst(measurement.values);
  publish(host, measurement.values);
  set_status(host, decisive.verdict().value_or(Verdict::Good));
  MeasuringLog log(context.descriptor(), host);
  add_values(log, measurement.values);
  log.section("Further results");
  log.length("Measuring height", to_length(context.number(261)));
  add_short_arc(log, measurement.form);
  TRY(deliver_log(context, std::move(log)));
  const MeasuringRecord record = record_of(context, measurement);
  for (const MeasuredValue& size : record.sizes) {
    const bool is_size = gauging::has_feature(quantity_of(record.cycle, size.is_position()));
    if (!is_size || !size.limits || size.limits->lower != Length{}) continue;
    TRY(host.note(
        fmt::format("the minimum of \"{}\" is 0: no size is too small", size.characteristic)));
  }
  host.record(record);
  TRY(correct_tool(context, measurement.correction));
  const int error = decisive.error();
  if (context.whole(309) != 0 && error != 0) return tolerance_stop(error);
  return {};
}

std::array<MeasuredValue, 2> centre_values(const Arguments& arguments, const Vec3& centre) {
  const auto value = [&](int axis, std::string_view characteristic) {
    const Length nominal = to_length(arguments.number(273 + axis));
    return MeasuredValue{
        .characteristic = characteristic,
        .role = ValueRole::Position,
        .nominal = nominal,
        .measured = to_length(centre[static_cast<std::size_t>(axis)]),
        .limits = position_limits(nominal, to_length(arguments.number(279 + axis))),
        .result_q = static_cast<std::uint16_t>(151 + axis),
        .deviation_q = static_cast<std::uint16_t>(161 + axis),
        .error_too_large = 1044 + axis,
        .error_too_small = 1044 + axis};
  };
  return {value(0, "Centre, main axis"), value(1, "Centre, secondary axis")};
}

}  // namespace fitgauge::probing
