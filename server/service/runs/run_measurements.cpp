#include "service/runs/run_measurements.hpp"

#include <algorithm>

namespace fitgauge::app {
namespace {

using probing::MeasuredSize;

Measurement record_of(const RunReport& report, const interpreter::Measurement& measured,
                      const MeasuredSize& size, const std::optional<std::string>& caller) {
  Measurement record;
  record.source = Source::Simulation;
  record.measured_at = record.received_at = report.finished_at;
  record.characteristic = size.characteristic;
  const auto& [part_id, order] = report.subject;
  if (!part_id.empty()) record.part_id = part_id;
  if (!order.empty()) record.order = order;
  if (caller) record.caller = *caller;
  record.run_id = report.id;
  record.origin = report.origin;
  record.cycle = measured.record.cycle;
  std::optional<SizeLimits> limits;
  if (size.limits) limits = {.upper = size.limits->upper, .lower = size.limits->lower};
  judge_size(record, {.feature = size.feature,
                      .is_position = size.is_position,
                      .nominal = size.nominal,
                      .measured = size.measured,
                      .limits = limits});
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
