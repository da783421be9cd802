#include "plant/sparkplug/edge_node.hpp"

#include <sparkplug/sparkplug_wire.pb.h>

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

using app::Measurement;
using Type = SparkplugType;
using Value = SparkplugValue;

/// The nearest double: from nanometres, so that 13 µm are 13 and not 13.000000000000002.
Value um(Length length) { return static_cast<double>(length.count()) / 1e3; }
Value mm(Length length) { return length.to_mm(); }
Value text(const std::optional<std::string_view>& text) {
  return text ? Value(std::string(*text)) : Value();
}

/// Metrics of a device's last measurement, equal for every quantity, so that a birth names all
/// later metrics.
std::vector<SparkplugMetric> metrics_of(const Measurement& m) {
  const Timestamp at = m.measured_at;
  const Length deviation = m.has_nominal() ? m.decisive() - m.nominal_size : Length();
  const Value none;
  return {
      {"id", {}, Type::String, at, app::measurement_id_text(m.id, m.origin)},
      {"measured_mm", {}, Type::Double, at, mm(m.measured)},
      {"verdict", {}, Type::String, at, text(word(m.result.verdict))},
      {"deviation_um", {}, Type::Double, at, m.has_nominal() ? um(deviation) : none},
      {"excess_um", {}, Type::Double, at, m.is_judged() ? um(m.result.excess) : none},
      {"nominal_mm", {}, Type::Double, at, m.has_nominal() ? mm(m.nominal_size) : none},
      {"upper_limit_mm", {}, Type::Double, at, m.has_upper_limit() ? mm(m.upper_limit()) : none},
      {"lower_limit_mm", {}, Type::Double, at, m.has_lower_limit() ? mm(m.lower_limit()) : none},
      {"tolerance_class", {}, Type::String, at, text(m.class_name)},
      {"measured_at", {}, Type::DateTime, at, milliseconds(at)},
      {"part_id", {}, Type::String, at, text(m.part_id)},
      {"characteristic", {}, Type::String, at, text(m.characteristic)},
      {"order", {}, Type::String, at, text(m.order)},
      {"operation", {}, Type::String, at, text(m.operation)},
      {"machine", {}, Type::String, at, text(m.machine)},
      {"operator", {}, Type::String, at, text(m.operator_id)},
      {"gauge", {}, Type::String, at, text(m.gauge)},
  };
}

constexpr std::uint64_t kPositionAlias = 1;

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
  return std::ranges::any_of(payload.metrics(), [](const sparkplug_wire::Metric& metric) {
    return metric.name() == kRebirth && metric.boolean_value();
  });
}

EdgeNode::EdgeNode(const SparkplugOptions& options, const Clock& clock, Send send)
    : options_(options), clock_(clock), send_(std::move(send)), next_alias_(kPositionAlias + 1) {}

SparkplugMetric EdgeNode::session_metric() const {
  return {
      .name = "bdSeq", .type = Type::Int64, .at = clock_.now(), .value = std::int64_t{session_}};
}

MqttMessage EdgeNode::death() const {
  return {.topic = topic("NDEATH"),
          .payload = sparkplug_payload(clock_.now(), {}, {session_metric()}),
          .qos = 1};
}

void EdgeNode::send(std::string_view type, std::string_view device,
                    const std::vector<SparkplugMetric>& metrics) {
  send_({.topic = topic(type, device),
         .payload = sparkplug_payload(clock_.now(), seq_, metrics),
         .qos = 0});
  ++seq_;  // 0 comes after 255
}

void EdgeNode::give_birth() {
  seq_ = 0;
  const Timestamp now = clock_.now();
  send("NBIRTH", {},
       {session_metric(),
        {.name = std::string(kRebirth), .type = Type::Boolean, .at = now, .value = false},
        {.name = "position",
         .alias = kPositionAlias,
         .type = Type::Int64,
         .at = now,
         .value = position_}});
  for (const Device& device : devices_) send_birth(device);
}

EdgeNode::Device& EdgeNode::device_of(const std::string& id, std::vector<SparkplugMetric> metrics) {
  if (const auto known = by_id_.find(id); known != by_id_.end()) {
    devices_.splice(devices_.end(), devices_, known->second);
    return devices_.back();
  }
  if (devices_.size() == options_.most_devices) {
    send("DDEATH", devices_.front().id, {});
    by_id_.erase(devices_.front().id);
    devices_.pop_front();
  }
  for (SparkplugMetric& metric : metrics) {
    metric.alias = next_alias_++;
    metric.at = clock_.now();
    metric.value = std::monostate();
  }
  Device& device = devices_.emplace_back(Device{.id = id, .metrics = std::move(metrics)});
  by_id_.emplace(id, std::prev(devices_.end()));
  send_birth(device);
  return device;
}

void EdgeNode::tell(const app::Measurement& measurement) {
  std::vector<SparkplugMetric> told = metrics_of(measurement);
  Device& device = device_of(options_.device.topic_of(measurement), told);
  for (std::size_t i = 0; i < told.size(); ++i) {
    told[i].alias = device.metrics[i].alias;
    device.metrics[i] = told[i];
    // Only births need the name: data has the alias.
    told[i].name.clear();
    told[i].type.reset();
  }
  send("DDATA", device.id, told);
}

void EdgeNode::tell_position(std::int64_t position) {
  position_ = position;
  send("NDATA", {}, {{.alias = kPositionAlias, .at = clock_.now(), .value = position_}});
}

void HostState::take(std::string_view payload) {
  const auto state = parse_json(payload);
  if (!state || !state->is(JsonValue::Kind::Object)) return;
  const JsonValue* const online = state->find("online");
  const JsonValue* const time = state->find("timestamp");
  const bool is_whole = online != nullptr && online->is(JsonValue::Kind::Boolean) &&
                        time != nullptr && time->is(JsonValue::Kind::Number);
  if (!is_whole) return;
  const auto timestamp = read_number<std::int64_t>(time->text);
  if (!timestamp || timestamp < timestamp_) return;
  timestamp_ = timestamp;
  is_online_ = online->boolean;
}

}  // namespace fitgauge::connections
