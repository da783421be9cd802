#include "nc/probing/measuring_record.hpp"

#include "metrology/gauging/gauge.hpp"

namespace fitgauge::probing {

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
