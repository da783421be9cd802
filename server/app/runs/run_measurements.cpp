#include "app/runs/run_measurements.hpp"

#include <algorithm>

namespace fitgauge::app {
namespace {

using probing::MeasuredSize;

constexpr probing::Limits kUnlimited{.upper = kLongest, .lower = -kLongest};

/// A hole that is too small could be reworked; a position that is out of its limits is scrap on
/// either side.
iso286::Feature feature_of(const MeasuredSize& size, const probing::Limits& limits) {
  if (!size.is_position) return size.feature;
  return size.measured > limits.upper ? iso286::Feature::Hole : iso286::Feature::Shaft;
}

Measurement record_of(const RunReport& report, const interpreter::Measurement& measured,
                      const MeasuredSize& size, const std::optional<std::string>& caller) {
  const probing::Limits limits = size.limits.value_or(kUnlimited);
  Measurement record;
  record.source = Source::Simulation;
  record.measured_at = record.received_at = report.finished_at;
  record.nominal_size = size.nominal;
  record.feature = feature_of(size, limits);
  record.deviations = {.upper = limits.upper - size.nominal, .lower = limits.lower - size.nominal};
  record.basis = LimitsBasis::Explicit;
  record.measured = size.measured;
  record.texts.characteristic = size.characteristic;
  if (caller) record.caller = *caller;
  record.run_id = report.id;
  record.origin = report.origin;
  record.cycle = measured.record.cycle;
  if (!size.limits) {
    // Nothing judges it: an uncertainty as wide as its limits makes it indeterminate.
    record.rule = gauging::DecisionRule::guard_band(kLongest).value();
    record.standard_uncertainty = kLongest;
    record.coverage_factor = record.rule.coverage_factor();
  }
  judge(record);
  return record;
}

}  // namespace

std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller) {
  std::vector<Measurement> records;
  for (const interpreter::Measurement& measured : report.result.measurements) {
    const auto& sizes = measured.record.sizes;
    const auto is_judged = [](const MeasuredSize& size) { return size.limits.has_value(); };
    const bool judges = std::ranges::any_of(sizes, is_judged);
    for (const MeasuredSize& size : sizes) {
      if (judges && !is_judged(size)) continue;
      records.push_back(record_of(report, measured, size, caller));
      if (!judges) break;
    }
  }
  return records;
}

}  // namespace fitgauge::app
