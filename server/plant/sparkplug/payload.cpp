#include "plant/sparkplug/payload.hpp"

#include <sparkplug/sparkplug_wire.pb.h>

#include <algorithm>

namespace fitgauge::connections {
namespace {

struct SetValue {
  sparkplug_wire::Metric& metric;

  void operator()(std::monostate) const { metric.set_is_null(true); }
  void operator()(bool value) const { metric.set_boolean_value(value); }
  void operator()(std::int64_t value) const {
    metric.set_long_value(static_cast<std::uint64_t>(value));
  }
  void operator()(double value) const { metric.set_double_value(value); }
  void operator()(const std::string& value) const { metric.set_string_value(value); }
};

}  // namespace

std::int64_t milliseconds(Timestamp time) {
  return std::max<std::int64_t>(time.nanoseconds, 0) / 1'000'000;
}

std::string sparkplug_payload(Timestamp sent_at, std::optional<std::uint8_t> seq,
                              const std::vector<SparkplugMetric>& metrics) {
  sparkplug_wire::Payload payload;
  payload.set_timestamp(static_cast<std::uint64_t>(milliseconds(sent_at)));
  if (seq) payload.set_seq(*seq);
  for (const SparkplugMetric& metric : metrics) {
    sparkplug_wire::Metric& added = *payload.add_metrics();
    if (!metric.name.empty()) added.set_name(metric.name);
    if (metric.alias) added.set_alias(*metric.alias);
    if (metric.type) added.set_datatype(static_cast<std::uint32_t>(*metric.type));
    added.set_timestamp(static_cast<std::uint64_t>(milliseconds(metric.at)));
    std::visit(SetValue{added}, metric.value);
  }
  return payload.SerializeAsString();
}

bool asks_for_rebirth(std::string_view bytes) {
  sparkplug_wire::Payload payload;
  if (!payload.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return false;
  return std::any_of(payload.metrics().begin(), payload.metrics().end(),
                     [](const sparkplug_wire::Metric& metric) {
                       return metric.name() == kRebirth && metric.boolean_value();
                     });
}

}  // namespace fitgauge::connections
