#include "nc/probing/measured_value.hpp"

namespace fitgauge::probing {

using gauging::Verdict;

Verdict MeasuredValue::verdict() const {
  if (!limits) return Verdict::Good;
  if (role == ValueRole::Position) {
    const bool inside = measured >= limits->lower && measured <= limits->upper;
    return inside ? Verdict::Good : Verdict::Reject;
  }
  const auto feature = role == ValueRole::HoleSize ? iso286::Feature::Hole : iso286::Feature::Shaft;
  return gauging::gauge(feature, limits->upper, limits->lower, measured).verdict;
}

int MeasuredValue::error() const {
  if (verdict() == Verdict::Good) return 0;
  return measured > limits->upper ? error_too_large : error_too_small;
}

Length to_length(double mm) { return Length::nearest_mm(mm).value(); }

void set_lengths(CycleHost& host, std::size_t first, std::initializer_list<double> mm) {
  for (const double length : mm)
    host.set_q(static_cast<std::uint16_t>(first++), to_length(length).to_mm(), Unit::Length);
}

double to_angle(double degrees) { return std::round(degrees * 1e7) / 1e7; }

CycleResult<std::optional<Limits>> size_limits(const Arguments& arguments, int max_q, int min_q) {
  const Limits limits{to_length(arguments.number(max_q)), to_length(arguments.number(min_q))};
  if (limits == Limits{}) return std::optional<Limits>{};
  if (limits.upper < limits.lower) {
    return nc_error(1016, "maximum Q{} = {} is less than minimum Q{} = {}", max_q,
                    format_mm(limits.upper), min_q, format_mm(limits.lower));
  }
  return std::optional(limits);
}

std::optional<Limits> position_limits(Length nominal, Length tolerance) {
  if (tolerance == Length{}) return std::nullopt;
  return Limits{nominal + tolerance, nominal - tolerance};
}

gauging::DecisionRule MeasuredSize::rule() const {
  return uncertainty ? gauging::DecisionRule::guard_band(*uncertainty).value()
                     : gauging::DecisionRule();
}

void judge_by_uncertainty(MeasuringRecord& record) {
  if (!record.form || !record.form->touch_uncertainty_um) return;
  const auto uncertainty =
      gauging::rounded_up(record.form->diameter_factor * *record.form->touch_uncertainty_um);
  std::optional<gauging::Verdict> worst;
  for (MeasuredSize& size : record.sizes) {
    const gauging::Quantity quantity = quantity_of(record.cycle, size.is_position);
    if (!size.limits || quantity != gauging::Quantity::Diameter) continue;
    size.uncertainty = uncertainty;
    size.verdict = gauging::gauge(size.feature, size.limits->upper, size.limits->lower,
                                  size.measured, size.rule())
                       .verdict;
  }
  for (const MeasuredSize& size : record.sizes) {
    if (gauging::severity(worst) < gauging::severity(size.verdict)) worst = size.verdict;
  }
  if (worst) record.verdict = worst;
}

}  // namespace fitgauge::probing
