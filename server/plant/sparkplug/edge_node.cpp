#include "plant/sparkplug/edge_node.hpp"

#include <fmt/format.h>

#include <iterator>
#include <utility>

namespace fitgauge::connections {
namespace {

using Type = SparkplugType;

constexpr std::uint64_t kPositionAlias = 1;

/// As births show it, or with its alias alone, as data does.
SparkplugMetric without_name(SparkplugMetric metric) {
  metric.name.clear();
  metric.type.reset();
  return metric;
}

}  // namespace

EdgeNode::EdgeNode(const SparkplugOptions& options, const Clock& clock, Send send)
    : options_(options), clock_(clock), send_(std::move(send)), next_alias_(kPositionAlias + 1) {}

void EdgeNode::begin_session(std::uint8_t number) { session_ = number; }

std::string EdgeNode::topic(std::string_view type, std::string_view device) const {
  return fmt::format("spBv1.0/{}/{}/{}{}{}", options_.group, type, options_.node,
                     device.empty() ? "" : "/", device);
}

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

void EdgeNode::send_birth(const Device& device) { send("DBIRTH", device.id, device.metrics); }

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

}  // namespace fitgauge::connections
