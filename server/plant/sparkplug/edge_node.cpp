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
using app::MeasurementFields;
using Type = SparkplugType;
using Value = SparkplugValue;

Value text_or_null(const std::optional<std::string_view>& text) {
  return text ? Value(std::string(*text)) : Value();
}

template <std::optional<std::string_view> MeasurementFields::*kText>
Value text(const Measurement& measurement) {
  return text_or_null(measurement.*kText);
}

/// The nearest double: from nanometres, so that 13 µm are 13 and not 13.000000000000002.
double um(Length length) { return static_cast<double>(length.count()) / 1e3; }

constexpr std::uint64_t kPositionAlias = 1;

/// Removes the name, which only births need: data has the alias.
SparkplugMetric without_name(SparkplugMetric metric) {
  metric.name.clear();
  metric.type.reset();
  return metric;
}

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

const std::array<DeviceMetric, 17> kDeviceMetrics = {{
    {"id", Type::String,
     [](const Measurement& m) { return Value(app::measurement_id_text(m.id, m.origin)); }},
    {"measured_mm", Type::Double, [](const Measurement& m) { return Value(m.measured.to_mm()); }},
    {"verdict", Type::String,
     [](const Measurement& m) { return Value(std::string(word(m.result.verdict))); }},
    {"deviation_um", Type::Double,
     [](const Measurement& m) {
       return m.has_nominal ? Value(um(m.decisive() - m.nominal_size)) : Value();
     }},
    {"excess_um", Type::Double,
     [](const Measurement& m) { return m.is_judged() ? Value(um(m.result.excess)) : Value(); }},
    {"nominal_mm", Type::Double,
     [](const Measurement& m) { return m.has_nominal ? Value(m.nominal_size.to_mm()) : Value(); }},
    {"upper_limit_mm", Type::Double,
     [](const Measurement& m) {
       return m.has_upper_limit() ? Value(m.upper_limit().to_mm()) : Value();
     }},
    {"lower_limit_mm", Type::Double,
     [](const Measurement& m) {
       return m.has_lower_limit() ? Value(m.lower_limit().to_mm()) : Value();
     }},
    {"tolerance_class", Type::String,
     [](const Measurement& m) { return text_or_null(m.class_name); }},
    {"measured_at", Type::DateTime,
     [](const Measurement& m) { return Value(milliseconds(m.measured_at)); }},
    {"part_id", Type::String, text<&MeasurementFields::part_id>},
    {"characteristic", Type::String, text<&MeasurementFields::characteristic>},
    {"order", Type::String, text<&MeasurementFields::order>},
    {"operation", Type::String, text<&MeasurementFields::operation>},
    {"machine", Type::String, text<&MeasurementFields::machine>},
    {"operator", Type::String, text<&MeasurementFields::operator_id>},
    {"gauge", Type::String, text<&MeasurementFields::gauge>},
}};

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

EdgeNode::Device& EdgeNode::device_of(const std::string& id) {
  if (const auto known = by_id_.find(id); known != by_id_.end()) {
    devices_.splice(devices_.end(), devices_, known->second);
    return devices_.back();
  }
  if (devices_.size() == options_.most_devices) {
    send("DDEATH", devices_.front().id, {});
    by_id_.erase(devices_.front().id);
    devices_.pop_front();
  }
  Device& device = devices_.emplace_back(Device{.id = id, .first_alias = next_alias_});
  next_alias_ += kDeviceMetrics.size();
  for (std::size_t i = 0; i < kDeviceMetrics.size(); ++i) {
    device.metrics.push_back({.name = std::string(kDeviceMetrics.at(i).name),
                              .alias = device.first_alias + i,
                              .type = kDeviceMetrics.at(i).type,
                              .at = clock_.now()});
  }
  by_id_.emplace(id, std::prev(devices_.end()));
  send_birth(device);
  return device;
}

void EdgeNode::tell(const app::Measurement& measurement) {
  Device& device = device_of(options_.device.topic_of(measurement));
  std::vector<SparkplugMetric> told;
  for (std::size_t i = 0; i < kDeviceMetrics.size(); ++i) {
    device.metrics[i].at = measurement.measured_at;
    device.metrics[i].value = kDeviceMetrics.at(i).value(measurement);
    told.push_back(without_name(device.metrics[i]));
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
  std::int64_t timestamp = 0;
  const char* const end = time->text.data() + time->text.size();
  const auto read = std::from_chars(time->text.data(), end, timestamp);
  if (read.ec != std::errc() || read.ptr != end) return;
  if (timestamp_ && timestamp < *timestamp_) return;
  timestamp_ = timestamp;
  is_online_ = online->boolean;
}

}  // namespace fitgauge::connections
