#include "app/runs/run_measurements.hpp"

namespace fitgauge::app {
namespace {

constexpr probing::Limits kUnlimited{.upper = kLongest, .lower = -kLongest};

}  // namespace

std::vector<Measurement> measurements_of(const RunReport& report,
                                         const std::optional<std::string>& caller) {
  std::vector<Measurement> measurements;
  for (const interpreter::Measurement& measured : report.result.measurements) {
    if (measured.record.sizes.empty()) continue;
    const probing::MeasuredSize& size = measured.record.sizes.front();
    const probing::Limits limits = size.limits.value_or(kUnlimited);
    Measurement& measurement = measurements.emplace_back();
    measurement.source = Source::Simulation;
    measurement.measured_at = measurement.received_at = report.finished_at;
    measurement.nominal_size = size.nominal;
    measurement.feature = size.feature;
    measurement.deviations = {.upper = limits.upper - size.nominal,
                              .lower = limits.lower - size.nominal};
    measurement.basis = LimitsBasis::Explicit;
    measurement.measured = size.measured;
    measurement.texts.characteristic = size.characteristic;
    if (caller) measurement.caller = *caller;
    measurement.run_id = report.id;
    measurement.cycle = measured.record.cycle;
    judge(measurement);
  }
  return measurements;
}

}  // namespace fitgauge::app
